// The library from C: two bicubic patches on a grid, positions and normals in one vertex.
#include <stdio.h>

#include <simdbezier.h>

enum { kPatches = 2, kSide = 17, kSamples = kPatches * kSide * kSide, kVertex = 6 };

// 16 control points a patch, u fastest: a row of two hills.
static void fill(float* points) {
  for (int k = 0; k < 16 * kPatches; ++k) {
    points[3 * k] = (float)(k % 4 + k / 16 * 3);
    points[3 * k + 1] = (float)(k / 4 % 4);
    points[3 * k + 2] = (float)(k % 4 == 1 || k % 4 == 2);
  }
}

int main(void) {
  float points[48 * kPatches];
  fill(points);
  const simdbezier_nets nets =
      simdbezier_packed_nets_f32(points, 48 * kPatches, 3, 3, 3, SIMDBEZIER_POLYNOMIAL);
  simdbezier_patch_set* patches = NULL;
  if (simdbezier_pack(&nets, 1, SIMDBEZIER_F32, NULL, &patches) != SIMDBEZIER_OK) {
    puts(simdbezier_last_message());
    return 1;
  }

  static float vertices[kVertex * kSamples]; // x y z nx ny nz
  simdbezier_outputs out = {.struct_size = sizeof out};
  out.position = simdbezier_triples_f32(vertices, kVertex * kSamples, kVertex);
  out.normal = simdbezier_triples_f32(vertices + 3, kVertex * kSamples - 3, kVertex);
  const simdbezier_grid grid = simdbezier_uniform_grid(kSide, kSide);
  const simdbezier_status status = simdbezier_evaluate_grid(patches, &grid, &out, NULL);
  if (status == SIMDBEZIER_OK) {
    const float* const middle = vertices + kVertex * (8 * kSide + 8);
    printf("middle of patch 0: %g %g %g, normal %g %g %g\n", middle[0], middle[1], middle[2],
           middle[3], middle[4], middle[5]);
  } else {
    puts(simdbezier_last_message());
  }
  simdbezier_patch_set_free(patches);
  return status == SIMDBEZIER_OK ? 0 : 1;
}
