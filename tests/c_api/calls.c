// Polylines, and a mesh piece by piece in a compact format, as a program in C99 writes them.
#include <stdio.h>
#include <stdlib.h>

#include <simdbezier.h>

enum { kPatches = 3, kVertex = 12 };

// Says what was refused; 0 where nothing was.
static int failed(simdbezier_status status) {
  if (status != SIMDBEZIER_OK) {
    puts(simdbezier_last_message());
  }
  return status != SIMDBEZIER_OK;
}

// A row of patches that share edges.
static void fill(float* points) {
  for (int k = 0; k < 16 * kPatches; ++k) {
    points[3 * k] = (float)(k % 4 + k / 16 * 3);
    points[3 * k + 1] = (float)(k / 4 % 4);
    points[3 * k + 2] = (float)(k % 4 == 1 || k % 4 == 2);
  }
}

static int draw_lines(const float* points) {
  const simdbezier_control_curves curves =
      simdbezier_packed_curves_f32(points, 48 * kPatches, 3, 3, SIMDBEZIER_POLYNOMIAL);
  simdbezier_polylines* lines = NULL;
  simdbezier_polyline_arrays arrays = {.struct_size = sizeof arrays};
  int wrong = failed(simdbezier_flatten(&curves, SIMDBEZIER_F32, 1e-3, NULL, &lines)) ||
              failed(simdbezier_polylines_look(lines, &arrays));
  wrong = wrong || arrays.curves != 4 * kPatches ||
          arrays.first[arrays.curves] != arrays.vertices || arrays.deviation > 1e-3;
  simdbezier_polylines_free(lines);
  return wrong;
}

// The vertices and triangles of one patch of a plan.
static int write_patch(const simdbezier_mesh_plan_parts* plan, size_t patch,
                       simdbezier_quantisation_box box) {
  const size_t vertices = simdbezier_mesh_layout_first_vertex(plan->layout, patch + 1) -
                          simdbezier_mesh_layout_first_vertex(plan->layout, patch);
  const size_t length = 3 * (simdbezier_mesh_layout_first_triangle(plan->layout, patch + 1) -
                             simdbezier_mesh_layout_first_triangle(plan->layout, patch));
  unsigned char* const memory = malloc(kVertex * vertices);
  uint16_t* const triangles = malloc(length * sizeof *triangles);
  const simdbezier_formatted_outputs out = {
      .struct_size = sizeof out,
      .position = {memory, vertices, kVertex, SIMDBEZIER_FORMAT_UNORM16},
      .normal = {memory + 6, vertices, kVertex, SIMDBEZIER_FORMAT_OCTAHEDRAL8},
      .parameters = {memory + 8, vertices, kVertex, SIMDBEZIER_FORMAT_UNORM16},
      .box = box};
  const simdbezier_primitive_options some = {
      .struct_size = sizeof some, .first_patch = patch, .patch_count = 1};
  const int wrong =
      memory == NULL || triangles == NULL ||
      failed(simdbezier_evaluate_formatted_mesh(plan->set, plan->layout, &out, NULL, patch, 1)) ||
      failed(simdbezier_write_triangles_u16(plan->layout, triangles, length, &some));
  free(memory);
  free(triangles);
  return wrong;
}

static int write_mesh(const float* points) {
  const simdbezier_nets nets =
      simdbezier_packed_nets_f32(points, 48 * kPatches, 3, 3, 3, SIMDBEZIER_POLYNOMIAL);
  const simdbezier_mesh_options options = {.struct_size = sizeof options, .tolerance = 1e-3};
  simdbezier_mesh_plan* plan = NULL;
  simdbezier_mesh_plan_parts parts = {.struct_size = sizeof parts};
  simdbezier_quantisation_box box;
  int wrong = failed(simdbezier_plan_mesh(&nets, 1, SIMDBEZIER_F32, &options, &plan)) ||
              failed(simdbezier_mesh_plan_look(plan, &parts)) ||
              failed(simdbezier_find_quantisation_box(&nets, 1, SIMDBEZIER_FORMAT_UNORM16, &box)) ||
              parts.patch_count != kPatches || parts.deviation > 1e-3;
  for (size_t patch = 0; !wrong && patch < kPatches; ++patch) {
    wrong = write_patch(&parts, patch, box);
  }
  simdbezier_mesh_plan_free(plan);
  return wrong;
}

int main(void) {
  float points[48 * kPatches];
  fill(points);
  return draw_lines(points) || write_mesh(points);
}
