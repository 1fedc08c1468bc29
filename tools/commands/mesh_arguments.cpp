#include <tools/commands/mesh_arguments.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include <tools/formats/input/text_input.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/length.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

[[noreturn]] void refuse(int exit_code, const Words& words, const char* option,
                         const std::string& found) {
  throw Failure(exit_code, std::string(option) + ": expected " +
                               find_option(option, command_name(words.command))->expected +
                               ", found " + found);
}

// Reads a number that `fits`, in the option's own unit.
template <typename Fits>
std::optional<double> number(const Words& words, const char* option, Fits&& fits) {
  const std::optional<std::string> word = words.value(option);
  if (!word) {
    return std::nullopt;
  }
  const std::optional<double> value = parse_finite(*word);
  if (!value || !fits(*value)) {
    refuse(is_number(*word) ? 1 : 2, words, option, describe_non_number(*word));
  }
  return value;
}
// Reads N numbers separated by commas.
template <std::size_t N>
std::array<double, N> parse_numbers(const Words& words, const char* option,
                                    const std::string& text) {
  std::array<double, N> numbers{};
  std::string_view rest = text;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const bool last = k + 1 == numbers.size();
    const std::size_t end = last ? rest.size() : rest.find(',');
    const bool missing = end == std::string_view::npos;
    const std::string_view word = rest.substr(0, end);
    const auto value = missing ? std::nullopt : parse_finite(word);
    if (!value) {
      refuse(!missing && is_number(word) ? 1 : 2, words, option, in_quotes(text));
    }
    numbers[k] = *value;
    rest.remove_prefix(last ? end : end + 1);
  }
  return numbers;
}

std::array<double, 2> parse_picture(const Words& words) {
  constexpr std::uint64_t kMost = 65536;
  const std::string text = words.value("--picture").value_or("1920x1080");
  const std::size_t cross = std::min(text.find('x'), text.size());
  const auto width = parse_integer(text.substr(0, cross));
  const auto height = parse_integer(text.substr(std::min(cross + 1, text.size())));
  if (!width || !height || std::clamp<std::uint64_t>(*width, 1, kMost) != *width ||
      std::clamp<std::uint64_t>(*height, 1, kMost) != *height) {
    refuse(2, words, "--picture", in_quotes(text));
  }
  return {static_cast<double>(*width), static_cast<double>(*height)};
}

Camera parse_camera(const Words& words) {
  constexpr double kNearest = 1e-3; // a share of the distance to what is looked at
  const std::string text = *words.value("--camera");
  const std::array<double, 6> places = parse_numbers<6>(words, "--camera", text);
  const auto [width, height] = parse_picture(words);
  const double angle =
      number(words, "--view-angle", [](double v) { return v > 0 && v < 180; }).value_or(45);
  Camera camera;
  for (std::size_t c = 0; c < 3; ++c) {
    camera.eye[c] = places[c];
    camera.direction[c] = places[c + 3] - places[c];
  }
  const double distance = length_of(camera.direction);
  if (!(distance > 0 && std::isfinite(distance))) {
    refuse(1, words, "--camera", in_quotes(text));
  }
  camera.width = width;
  camera.height = height;
  camera.focal_length = height / (2 * std::tan(angle * kRadiansPerDegree / 2));
  camera.nearest = kNearest * distance;
  return camera;
}

void expect_with(const Words& words, const char* option, const char* other) {
  if (words.has(option) && !words.has(other)) {
    bad_usage(std::string(option) + ": expected with " + other + ", found without");
  }
}
void expect_without(const Words& words, const char* option, const char* other) {
  if (words.has(option) && words.has(other)) {
    bad_usage(std::string(option) + ": expected without " + other + ", found both");
  }
}

void check_combinations(const Words& words) {
  expect_with(words, "--pixels", "--camera");
  expect_with(words, "--camera", "--pixels");
  expect_with(words, "--view-angle", "--camera");
  expect_with(words, "--picture", "--camera");
  for (const char* const resolution : {"--tolerance", "--relative", "--pixels", "--angle"}) {
    expect_without(words, resolution, "--grid");
    expect_without(words, resolution, "--no-weld");
  }
  for (const char* const joined :
       {"--snap", "--split-edges", "--point-size", "--crease", "--orient", "--drop-repeated"}) {
    expect_without(words, joined, "--no-weld");
  }
  expect_without(words, "--weld", "--no-weld");
  if (words.value("--cells") == "bezier") { // which have no gaps to be closed, and no normals
    for (const char* const of_triangles :
         {"--grid", "--tolerance", "--relative", "--pixels", "--angle", "--weld", "--snap",
          "--split-edges", "--point-size", "--crease", "--orient", "--flip", "--drop-repeated",
          "--quads", "--parameters", "--curvature"}) {
      if (words.has(of_triangles)) {
        bad_usage(std::string(of_triangles) + ": expected without --cells bezier, found both");
      }
    }
  }
  expect_without(words, "--crease", "--no-normals");
}

MeshFormat parse_format(const Words& words) {
  const std::string out = *words.value("-o");
  if (const auto name = words.value("--to")) {
    const auto format = mesh_format_of("mesh." + *name, words.of_ranks);
    if (!format) {
      refuse(2, words, "--to", in_quotes(*name) + mesh_format_hint("mesh." + *name));
    }
    const auto named = mesh_format_of(out, words.of_ranks);
    if (!is_written_directly(out) && named && named != format) {
      bad_usage("--to: expected the format of " + out + ", found " + in_quotes(*name));
    }
    return *format;
  }
  const auto format = mesh_format_of(out, words.of_ranks);
  if (!format) {
    refuse(2, words, "-o", in_quotes(out) + mesh_format_hint(out));
  }
  return *format;
}

void parse_contents(const Words& words, MeshArguments& mesh) {
  mesh.format = parse_format(words);
  const MeshAbilities& can = mesh_abilities(mesh.format);
  mesh.normals = !words.has("--no-normals") && can.normals;
  mesh.weld = !words.has("--no-weld");
  mesh.flip = words.has("--flip");
  mesh.orient = words.has("--orient");
  mesh.split_edges = words.has("--split-edges");
  mesh.drop_repeated = words.has("--drop-repeated");
  mesh.quads = words.has("--quads");
  const auto expect = [&](const char* option, bool MeshAbilities::*ability) {
    if (!(can.*ability)) {
      bad_usage(option + (": expected an output in " + mesh_format_names("", ability)) +
                ", found " + mesh_format_name(mesh.format));
    }
  };
  mesh.parameters = words.has("--parameters");
  if (mesh.parameters) {
    expect("--parameters", &MeshAbilities::normals); // vertices have both or none
  }
  if (mesh.quads) {
    expect("--quads", &MeshAbilities::quads);
  }
  mesh.curvature = words.has("--curvature");
  if (mesh.curvature) {
    expect("--curvature", &MeshAbilities::point_data);
  }
  if (const auto cells = words.value("--cells"); cells && *cells != "triangles") {
    if (*cells != "bezier") {
      refuse(2, words, "--cells", in_quotes(*cells));
    }
    expect("--cells bezier", &MeshAbilities::point_data);
    mesh.bezier_cells = true;
  }
  if (const auto bits = words.value("--quantise")) {
    if (*bits != "16" && *bits != "8") {
      refuse(2, words, "--quantise", in_quotes(*bits));
    }
    expect("--quantise", &MeshAbilities::quantised);
    mesh.storage = *bits == "16" ? VertexStorage::quantised_16 : VertexStorage::quantised_8;
  }
}

void parse_origin(const Words& words, MeshArguments& mesh) {
  const std::string text = words.value("--origin").value_or("none");
  mesh.own_origin = text == "auto";
  if (text != "auto" && text != "none") {
    mesh.origin = parse_numbers<3>(words, "--origin", text);
  }
}

// Floats can be stored in all formats, doubles where they are computed and the format has them.
bool parse_floats(const Words& words, MeshFormat format) {
  const std::string type = words.value("--vertex-precision").value_or("");
  if (type == "f64") {
    if (words.value("--precision") != "f64") {
      bad_usage("--vertex-precision: expected f64 with --precision f64, found without");
    }
    if (!mesh_abilities(format).doubles) {
      bad_usage("--vertex-precision: expected f64 for an output in " +
                mesh_format_names("", &MeshAbilities::doubles) + ", found " +
                mesh_format_name(format));
    }
  } else if (words.has("--vertex-precision") && type != "f32") {
    refuse(2, words, "--vertex-precision", in_quotes(type));
  }
  return type == "f32";
}

StatsForm parse_stats(const Words& words) {
  const auto form = words.value("--stats");
  if (!form) {
    return StatsForm::none;
  }
  if (const std::string out = *words.value("-o");
      *form == "json" && mixes_with_standard_output(out)) {
    bad_usage("--stats: expected json for an output that is not standard output, found -o " + out +
              (out == "-" ? "" : ", which is standard output"));
  }
  if (!form->empty() && *form != "text" && *form != "json") {
    refuse(2, words, "--stats", in_quotes(*form));
  }
  return *form == "json" ? StatsForm::json : StatsForm::text;
}

} // namespace

std::optional<double> positive(const Words& words, const char* option) {
  return number(words, option, [](double value) { return value > 0; });
}

MeshArguments parse_mesh_arguments(const Words& words) {
  check_combinations(words);
  MeshArguments mesh;
  parse_contents(words, mesh);
  mesh.stats = parse_stats(words);
  mesh.tolerance = positive(words, "--tolerance");
  mesh.relative = positive(words, "--relative");
  mesh.pixels = positive(words, "--pixels");
  mesh.angle = number(words, "--angle", [](double v) { return v > 0 && v <= 180; });
  mesh.crease = number(words, "--crease", [](double v) { return v >= 0 && v <= 180; });
  mesh.snap = positive(words, "--snap").value_or(0);
  mesh.point_size = positive(words, "--point-size").value_or(0);
  parse_origin(words, mesh);
  mesh.floats = parse_floats(words, mesh.format);
  if (mesh.pixels) {
    mesh.camera = parse_camera(words);
  }
  mesh.thorough = words.has("--thorough");
  if (mesh.thorough && !mesh.tolerance && !mesh.relative && !mesh.pixels) {
    bad_usage("--thorough: expected with --tolerance, --relative or --pixels, found without");
  }
  return mesh;
}

} // namespace simdbezier::tools
