// simdbezier convert: patches from one format to another.
#include <tools/commands/commands.hpp>

#include <numeric>
#include <vector>

#include <tools/patches/patch_order.hpp>
#include <tools/patches/write_patches.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

void run_convert(const Arguments& arguments) {
  refuse_input_as_output(arguments.out, inputs_of(arguments));
  const PatchFile file = read_input(arguments);
  std::vector<std::uint32_t> order(file.count);
  std::iota(order.begin(), order.end(), 0U);
  if (arguments.sort) {
    order = curve_order(file);
  }
  write_patches(file, order, arguments.out, arguments.written);
}

} // namespace simdbezier::tools
