#include <tools/patches/write_patches.hpp>

#include <algorithm>
#include <array>
#include <string_view>

#include <tools/patches/write_sbp.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

using Order = std::span<const std::uint32_t>;

// A patch that is to be written; point k has its values from value(k) on, u fastest.
struct WrittenPatch {
  const PatchFile& file;
  const PatchRun& run;
  std::uint32_t number;
  [[nodiscard]] std::vector<double> point(std::size_t i, std::size_t j) const {
    return file.point(number, j * (static_cast<std::size_t>(run.degree_u) + 1) + i);
  }
};

template <typename Visit>
void for_patches(const PatchFile& file, Order order, const Visit& visit) {
  for (const std::uint32_t number : order) {
    visit(WrittenPatch{file, file.run_of(number), number});
  }
}

void refuse(const WrittenPatch& patch, const std::string& expected) {
  const bool rational = patch.run.rational();
  bad_input(patch.file.name + ": expected " + expected + ", found patch " +
            std::to_string(patch.number) + " of degrees " + std::to_string(patch.run.degree_u) +
            " and " + std::to_string(patch.run.degree_v) +
            (!rational                                   ? ""
             : patch.run.weights == Weights::homogeneous ? " with homogeneous weights"
                                                         : " with Cartesian weights"));
}

// The points row by row, a line each.
void points(const WrittenPatch& patch, OutputFile& out) {
  for (std::size_t j = 0; j <= static_cast<std::size_t>(patch.run.degree_v); ++j) {
    for (std::size_t i = 0; i <= static_cast<std::size_t>(patch.run.degree_u); ++i) {
      char separator = '\0';
      for (const double value : patch.point(i, j)) {
        separator == '\0' ? void() : out.character(separator);
        out.number(value);
        separator = ' ';
      }
      out.character('\n');
    }
  }
}

void write_counted(const PatchFile& file, Order order, OutputFile& out, bool degrees) {
  out.number(order.size());
  out.character('\n');
  for_patches(file, order, [&](const WrittenPatch& patch) {
    if (patch.run.rational() ||
        (!degrees && (patch.run.degree_u != 3 || patch.run.degree_v != 3))) {
      refuse(patch, degrees ? "patches without weights for a .bpt file"
                            : "bicubic patches without weights for a .bez file");
    }
    if (degrees) {
      out.number(patch.run.degree_v);
      out.character(' ');
      out.number(patch.run.degree_u);
      out.character('\n');
    }
    points(patch, out);
  });
}

void write_bez(const PatchFile& file, Order order, OutputFile& out) {
  write_counted(file, order, out, false);
}
void write_bpt(const PatchFile& file, Order order, OutputFile& out) {
  write_counted(file, order, out, true);
}

// A surface for each patch, with vertices of its own; all of them may be rational.
void write_obj(const PatchFile& file, Order order, OutputFile& out) {
  std::size_t vertices = 0;
  for_patches(file, order, [&](const WrittenPatch& patch) {
    if (patch.run.weights == Weights::homogeneous) {
      refuse(patch, "patches without weights or with Cartesian ones for an .obj file");
    }
    for (std::size_t j = 0; j <= static_cast<std::size_t>(patch.run.degree_v); ++j) {
      for (std::size_t i = 0; i <= static_cast<std::size_t>(patch.run.degree_u); ++i) {
        out.character('v');
        for (const double value : patch.point(i, j)) {
          out.character(' ');
          out.number(value);
        }
        out.character('\n');
      }
    }
    out.text(patch.run.rational() ? "cstype rat bezier\ndeg " : "cstype bezier\ndeg ");
    out.number(patch.run.degree_u);
    out.character(' ');
    out.number(patch.run.degree_v);
    out.text("\nsurf 0 1 0 1");
    for (std::size_t k = 0; k < patch.run.points_per_patch(); ++k) {
      out.character(' ');
      out.number(++vertices);
    }
    out.text("\nparm u 0 1\nparm v 0 1\nend\n");
  });
}

struct Format {
  PatchFormat format;
  std::string_view name;
  void (*write)(const PatchFile&, Order, OutputFile&);
};
constexpr Format kFormats[] = {{PatchFormat::bez, "bez", write_bez},
                               {PatchFormat::bpt, "bpt", write_bpt},
                               {PatchFormat::obj, "obj", write_obj},
                               {PatchFormat::sbp, "sbp", write_sbp}};

} // namespace

std::string written_patch_formats(const std::string& prefix) {
  std::vector<std::string> names;
  for (const Format& format : kFormats) {
    names.push_back(prefix + std::string(format.name));
  }
  return alternatives(names);
}

std::optional<PatchFormat> written_patch_format(const std::string& name) {
  const auto* const format = std::ranges::find(kFormats, name, &Format::name);
  return format == std::end(kFormats) ? std::nullopt : std::optional(format->format);
}

void write_patches(const PatchFile& file, std::span<const std::uint32_t> order,
                   const std::string& out, PatchFormat format) {
  OutputFile to(out);
  std::ranges::find(kFormats, format, &Format::format)->write(file, order, to);
  to.commit();
}

} // namespace simdbezier::tools
