#!/usr/bin/env python3
"""Renders docs/pictures/meshes.png: the teapot and Gumbo as the program tessellates them, with POV-Ray.

    docs/pictures/meshes_picture.py build/simdbezier gumbo.bez      # Debian: povray

Each model is shown twice with the same certified deviation: on the left with one grid for all
patches, on the right with as few triangles as the tolerance needs. Ed Catmull's Gumbo is not part of
the project; its 128 patches are found in many collections of Bezier models as gumbo.bez.
"""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

RELATIVE = 4e-3  # tolerance, as a share of the diagonal of the model's box
WIDTH, HEIGHT = 1040, 764
# Views: from where, what is up, and how large and where in its panel.
MODELS = (("teapot", (0.42, -1.0, 0.52), (0, 0, 1)), ("gumbo", (-0.75, -1.0, 0.35), (0, 0, 1)))


def tessellate(program, model, options):
    """Vertices, normals and triangles, and what the program says about them."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "mesh.obj"
        done = subprocess.run([program, "tessellate", model, *options, "--stats=json", "-o", out],
                              check=True, capture_output=True, text=True)
        lines = [line.split() for line in out.read_text().splitlines()]
    vectors = {kind: [tuple(map(float, words[1:])) for words in lines if words[0] == kind]
               for kind in ("v", "vn")}
    faces = [tuple(int(word.split("/")[0]) - 1 for word in words[1:])
             for words in lines if words[0] == "f"]
    return vectors["v"], vectors["vn"], faces, json.loads(done.stdout)


def uniform_as_good(program, model, deviation):
    """The coarsest common grid with no larger deviation."""
    for side in range(2, 100):
        mesh = tessellate(program, model, ["--grid", str(side)])
        if mesh[3]["deviation"] <= deviation:
            return mesh
    sys.exit(f"no grid of {model} is as good as {deviation}")


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(x / length for x in a)


def view_of(eye, up):
    """Rows: right, up, towards the eye."""
    back = unit(eye)
    right = unit(cross(up, back))
    return right, cross(back, right), back


def fitted(points, view):
    """Points as they are seen, in the middle of a panel of size 1, and the scale."""
    seen = [tuple(dot(row, point) for row in view) for point in points]
    low = [min(point[c] for point in seen) for c in range(3)]
    high = [max(point[c] for point in seen) for c in range(3)]
    scale = 0.94 / max(high[0] - low[0], (high[1] - low[1]) * WIDTH / HEIGHT)
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    return [tuple((x - m) * scale for x, m in zip(point, middle)) for point in seen]


def vector(values):
    return "<" + ",".join(f"{value:.6f}" for value in values) + ">"


def mesh_text(points, normals, faces):
    def block(name, items):
        return f"{name} {{ {len(items)}, {', '.join(items)} }}\n"

    edges = {tuple(sorted((face[k - 1], face[k]))) for face in faces for k in range(3)}
    wires = "".join(f"cylinder {{ {vector(points[a])}, {vector(points[b])}, Wire }}\n"
                    for a, b in sorted(edges))
    return ("mesh2 {\n" + block("vertex_vectors", [vector(p) for p in points])
            + block("normal_vectors", [vector(n) for n in normals])
            + block("face_indices", [f"<{a},{b},{c}>" for a, b, c in faces])
            + "texture { Clay } }\nunion {\n" + wires + "texture { Ink } no_shadow }\n")


SCENE = """#version 3.7;
global_settings { assumed_gamma 1.0 }
background { color rgb 1 }
camera { orthographic location <0, 0, 10> look_at <0, 0, 0> up <0, 2 * %(tall)f, 0> right <-2, 0, 0> }
light_source { <-6, 9, 12> color rgb 0.85 parallel point_at <0, 0, 0> }
light_source { <9, 3, 6> color rgb 0.25 parallel point_at <0, 0, 0> shadowless }
#declare Wire = 0.0009;
#declare Clay = texture { pigment { color rgb <0.42, 0.63, 0.80> }
  finish { ambient 0.22 diffuse 0.75 specular 0.25 roughness 0.03 } }
#declare Ink = texture { pigment { color rgb <0.05, 0.13, 0.24> } finish { ambient 1 diffuse 0 } }
"""


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, gumbo = sys.argv[1:]
    tall = HEIGHT / WIDTH
    scene = SCENE % {"tall": tall}
    for row, (name, eye, up) in enumerate(MODELS):
        model = "builtin:teapot" if name == "teapot" else gumbo
        adaptive = tessellate(program, model, ["--relative", str(RELATIVE)])
        uniform = uniform_as_good(program, model, adaptive[3]["deviation"])
        for column, mesh in enumerate((uniform, adaptive)):
            points, normals, faces, stats = mesh
            view = view_of(eye, up)
            turned = [tuple(dot(line, normal) for line in view) for normal in normals]
            place = (column - 0.5, (0.5 - row) * tall, 0)
            scene += ("union {\n" + mesh_text(fitted(points, view), turned, faces)
                      + f"translate {vector(place)} }}\n")
            print(f"{name} {('uniform', 'adaptive')[column]}: {stats['triangles']} triangles, "
                  f"within {stats['deviation'] / stats['diagonal']:.2e} of the diagonal")
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "meshes.pov"
        source.write_text(scene)
        subprocess.run(["povray", f"+I{source}", f"+O{Path(__file__).with_name('meshes.png')}",
                        f"+W{WIDTH}", f"+H{HEIGHT}", "+A0.05", "+AM2", "+R4", "-D", "+FN8"],
                       check=True, capture_output=True)


if __name__ == "__main__":
    main()
