"""simdbezier for Conan 2: the library, without its program, benchmarks and tests."""
import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class SimdbezierConan(ConanFile):
    name = "simdbezier"
    license = "MIT"
    description = "Evaluates many Bezier patches at many parameters in one call"
    topics = ("bezier", "simd", "tessellation", "geometry")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": True, "fPIC": True}

    def validate(self):
        check_min_cppstd(self, 20)

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "README.md", "cmake/*", "docs/*", "include/*",
                        "kernels/*", "src/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def build_requirements(self):
        self.tool_requires("cmake/[>=3.21]")

    def requirements(self):
        self.requires("xsimd/[>=8.1]", headers=True, libs=False, visible=False)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["SIMDBEZIER_BUILD_TOOLS"] = False
        include = self.dependencies["xsimd"].cpp_info.includedirs[0]
        toolchain.cache_variables["SIMDBEZIER_XSIMD_INCLUDE_DIR"] = include
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "simdbezier")
        self.cpp_info.set_property("cmake_target_name", "simdbezier::simdbezier")
        self.cpp_info.libs = ["simdbezier"]
        if not self.options.shared:
            self.cpp_info.defines = ["SIMDBEZIER_STATIC"]
