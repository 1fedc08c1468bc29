// IGES files for tests, written from their entities as the specification says.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace simdbezier::tests {

/// An entity, whose number in the directory is 1, 3, 5 … in its order. Its parameters begin with
/// its type; their delimiters are , and ; or / and $.
struct IgesTextEntity {
  int type;
  std::string parameters;
  int matrix = 0;
  std::string status = "00000000";
  int form = 0;
};

inline std::string iges_line(std::string columns, char section, std::size_t number) {
  columns.resize(72, ' ');
  const std::string digits = std::to_string(number);
  return columns + section + std::string(7 - digits.size(), ' ') + digits + "\n";
}

inline std::string iges_field(const std::string& text) {
  return std::string(8 - text.size(), ' ') + text;
}

[[nodiscard]] inline std::string iges_text(const std::vector<IgesTextEntity>& entities,
                                           const std::string& global = "1H,,1H;,4Hpart;") {
  std::string directory;
  std::string parameters;
  std::size_t lines = 0;
  for (std::size_t k = 0; k < entities.size(); ++k) {
    const IgesTextEntity& entity = entities[k];
    const std::string type = std::to_string(entity.type);
    const std::size_t first = lines + 1;
    // Numbers do not go over the ends of lines.
    for (std::size_t at = 0; at < entity.parameters.size();) {
      std::size_t size = entity.parameters.size() - at;
      if (size > 64) {
        size = entity.parameters.find_last_of(",;/$", at + 63) + 1 - at;
      }
      std::string line = entity.parameters.substr(at, size);
      line.resize(64, ' ');
      parameters += iges_line(line + iges_field(std::to_string(2 * k + 1)), 'P', ++lines);
      at += size;
    }
    directory += iges_line(iges_field(type) + iges_field(std::to_string(first)) + iges_field("0") +
                               iges_field("0") + iges_field("0") + iges_field("0") +
                               iges_field(std::to_string(entity.matrix)) + iges_field("0") +
                               iges_field(entity.status),
                           'D', 2 * k + 1);
    directory += iges_line(iges_field(type) + iges_field("0") + iges_field("0") +
                               iges_field(std::to_string(lines + 1 - first)) +
                               iges_field(std::to_string(entity.form)),
                           'D', 2 * k + 2);
  }
  const auto count = [](char section, std::size_t number) {
    return section + iges_field(std::to_string(number)).substr(1);
  };
  return iges_line("a test", 'S', 1) + iges_line(global, 'G', 1) + directory + parameters +
         iges_line(count('S', 1) + count('G', 1) + count('D', 2 * entities.size()) +
                       count('P', lines),
                   'T', 1);
}

/// A bilinear patch of four points.
[[nodiscard]] inline std::string iges_bilinear(const std::string& points) {
  return "128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.," + points + ",0.,1.,0.,1.;";
}

} // namespace simdbezier::tests
