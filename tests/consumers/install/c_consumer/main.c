#include <stdio.h>

#include <simdbezier.h>

int main(void) {
  double points[48];
  for (int k = 0; k < 48; ++k) {
    points[k] = k % 3 == 0 ? k / 3 % 4 : k % 3 == 1 ? k / 12 : 0;
  }
  const simdbezier_nets nets = simdbezier_packed_nets_f64(points, 48, 3, 3, 3, 0);
  simdbezier_patch_set* set = NULL;
  double xyz[3 * 81];
  simdbezier_outputs out = {.struct_size = sizeof out};
  out.position = simdbezier_triples_f64(xyz, 3 * 81, 3);
  const simdbezier_grid grid = simdbezier_uniform_grid(9, 9);
  if (simdbezier_pack(&nets, 1, SIMDBEZIER_F64, NULL, &set) != SIMDBEZIER_OK ||
      simdbezier_evaluate_grid(set, &grid, &out, NULL) != SIMDBEZIER_OK) {
    puts(simdbezier_last_message());
    return 1;
  }
  printf("corner %g %g %g\n", xyz[0], xyz[1], xyz[2]);
  simdbezier_patch_set_free(set);
  return 0;
}
