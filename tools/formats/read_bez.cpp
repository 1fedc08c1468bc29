// Berkeley .bez: the number of patches, then 4 rows of 4 points x y z each. Files put from one
// number to a whole row on a line, so the layout means nothing.
#include <tools/formats/counted_patches.hpp>

namespace simdbezier::tools {

PatchFile read_bez(TextInput& input, const ReadOptions& /*options*/) {
  CountedPatches patches(input, " of 48 coordinates");
  while (patches.more()) {
    patches.patch(3, 3);
  }
  return patches.finish();
}

} // namespace simdbezier::tools
