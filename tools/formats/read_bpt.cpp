// Holmes3D .bpt: the number of patches, then per patch its degrees, first across the rows (in v),
// then along a row (in u), and its points x y z row by row.
#include <tools/formats/counted_patches.hpp>

namespace simdbezier::tools {

PatchFile read_bpt(TextInput& input, const ReadOptions& /*options*/) {
  CountedPatches patches(input, "");
  while (patches.more()) {
    const int degree_v = patches.degree("across the rows");
    const int degree_u = patches.degree("along a row");
    patches.patch(degree_u, degree_v);
  }
  return patches.finish();
}

} // namespace simdbezier::tools
