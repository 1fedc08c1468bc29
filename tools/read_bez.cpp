// Berkeley .bez: the number of patches, then 4 rows of 4 points x y z each. Files put from one
// number to a whole row on a line, so the layout means nothing; and counts lie in the wild.
#include <tools/patch_file.hpp>

namespace simdbezier::tools {

PatchFile read_bez(TextInput& input) {
  detail::PatchReader reader(input);
  for (std::size_t p = 0; p < reader.count(); ++p) {
    reader.coordinates();
  }
  return reader.finish();
}

} // namespace simdbezier::tools
