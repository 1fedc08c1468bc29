// Holmes3D .bpt: the number of patches, then per patch its degrees, first across the rows (in v),
// then along a row (in u), and its points x y z row by row.
#include <tools/patch_file.hpp>

#include <tools/failure.hpp>

namespace simdbezier::tools {

namespace {

void expect_degree_three(detail::PatchReader& reader, const std::string& which) {
  const auto word = reader.tokens().next();
  if (!word) {
    reader.ended_early();
  }
  if (parse_integer(*word) != 3U) {
    bad_input_at(reader.tokens().name(), reader.tokens().line(),
                 "degree 3 " + which + " (others are not supported yet)", in_quotes(*word));
  }
}

} // namespace

PatchFile read_bpt(TextInput& input) {
  detail::PatchReader reader(input);
  for (std::size_t p = 0; p < reader.count(); ++p) {
    expect_degree_three(reader, "across the rows");
    expect_degree_three(reader, "along a row");
    reader.coordinates();
  }
  return reader.finish();
}

} // namespace simdbezier::tools
