// The options of all commands: what is parsed, what messages expect, what help lists.
#include <tools/commands/command_line.hpp>

#include <simdbezier/simdbezier.hpp>
#include <tools/formats/csv.hpp>
#include <tools/formats/patch_file.hpp>
#include <tools/mesh_files/mesh_file.hpp>
#include <tools/patches/grid_blocks.hpp>
#include <tools/patches/write_patches.hpp>

namespace simdbezier::tools {

namespace {

using Entries = std::vector<OptionEntry>;

// Adds the options that say how fine a mesh is.
void add_resolution(Entries& entries) {
  const std::string command = " tessellate plan ";
  const std::string distance = "a distance above 0";
  entries.insert(
      entries.end(),
      {{"--tolerance", "D", distance,
        "The certified largest distance between triangles and surface", command},
       {"--relative", "S", "a share above 0",
        "The same as a share of the diagonal of the box of all control points", command},
       {"--pixels", "N", "a number above 0", "The same in pixels of a picture that --camera takes",
        command},
       {"--camera", "EYE,TARGET", "six numbers separated by commas, for two different points",
        "Where a picture is taken from, and the middle of what it shows; nothing closer than a "
        "thousandth of their distance is drawn",
        command},
       {"--view-angle", "DEG", "degrees above 0 and below 180",
        "The picture's angle from bottom to top (default 45)", command},
       {"--picture", "WxH", "WxH, each from 1 to 65536",
        "The picture's size in pixels (default 1920x1080)", command},
       {"--angle", "DEG", "degrees above 0 and at most 180",
        "About the largest angle between normals of neighbouring vertices", command},
       {"--thorough", "", "", "Fewer triangles within the distance, in more time", command}});
}

// Adds the options that say what a mesh consists of.
void add_mesh(Entries& entries) {
  const std::string command = " tessellate plan ";
  entries.insert(
      entries.end(),
      {{"--weld", "", "", "One mesh without gaps, as is usual", command},
       {"--no-weld", "", "",
        "Every patch as a grid of vertices of its own, instead of one mesh without gaps", command},
       {"--snap", "D", "a distance above 0",
        "Joins pairs of open edges that are this near to each other; shorter edges become points",
        command},
       {"--split-edges", "", "",
        "Cuts patches where corners of others lie on their open edges, so that these can be joined",
        command},
       {"--point-size", "D", "a distance above 0",
        "Makes points of edges whose control points are this near to both ends, also of those that "
        "patches share",
        command},
       {"--crease", "DEG", "degrees from 0 to 180",
        "Patches whose normals differ by this much where they meet do not share normals there",
        command},
       {"--orient", "", "", "Turns patches so that neighbours agree on the outside", command},
       {"--flip", "", "", "Turns all triangles and normals around", command},
       {"--drop-repeated", "", "", "Leaves out patches that repeat an earlier one", command},
       {"--quads", "", "",
        "Quads where cells have four vertices (" + mesh_format_names(".", &MeshAbilities::quads) +
            ")",
        command},
       {"--cells", "KIND", "bezier or triangles",
        "bezier: the patches themselves, of the same degrees and with their weights, instead of "
        "triangles (" +
            mesh_format_names(".", &MeshAbilities::point_data) + ")",
        command},
       {"--no-normals", "", "", "No normals", command},
       {"--parameters", "", "",
        "Each patch's own u, v as texture coordinates; patches share no vertices then, but normals "
        "(" +
            mesh_format_names(".", &MeshAbilities::normals) + ")",
        command},
       {"--curvature", "", "",
        "Gaussian, mean and both principal curvatures of every vertex, on the lowest patch that "
        "has it (" +
            mesh_format_names(".", &MeshAbilities::point_data) + ")",
        command},
       {"--quantise", "BITS", "16 or 8",
        "Stores positions in 16 bits and normals in this many (" +
            mesh_format_names(".", &MeshAbilities::quantised) + ")",
        command},
       {"--vertex-precision", "TYPE", "f32 or f64",
        "Numbers to store (default those of --precision; .stl and .glb have floats)", command},
       {"--origin", "POINT", "auto, x,y,z or none",
        "Where positions count from: auto is about the middle of the model, none (the default) is "
        "0; " +
            mesh_format_names(".", &MeshAbilities::moved) +
            " puts the mesh in its place by its node, other files name the origin, and so does "
            "stderr",
        command},
       {"--stats", "FORM", "text or json",
        "What was written, how long it took, and its certified deviation: text on stderr (the "
        "default) or JSON on standard output",
        " tessellate ", "", false}});
}

Entries make_entries() {
  const std::string all = " tessellate evaluate info convert plan ";
  const std::string both = " tessellate evaluate plan ";
  const std::string sides = "N or NUxNV, each from 2 to " + std::to_string(kMostPerDirection);
  Entries entries = {
      {"IN", "IN", "builtin:teapot, the name of a file or - for standard input",
       "Patches (" + patch_format_names(".") + ", compressed by gzip or not)", all},
      {"-o", "OUT", "a name that ends in " + mesh_format_names(".") + ", or - with --to",
       "Output, required; a device or pipe needs --to", " tessellate plan join "},
      {"--to", "NAME", mesh_format_names(""), "Format of OUT, otherwise told by its name",
       " tessellate plan join "},
      {"-o", "OUT", "a name that ends in " + written_patch_formats(".") + ", or - with --to",
       "Output, required; a device or pipe needs --to", " convert "},
      {"--to", "NAME", written_patch_formats(""), "Format of OUT, otherwise told by its name",
       " convert "},
      {"--sort", "", "",
       "Brings patches into an order in which neighbours are near each other, so that shards meet "
       "in few patches",
       " convert "},
      {"--shards", "N", "1 or more, and at most as many as there are patches",
       "Into how many parts the patches are cut", " plan join "},
      {"--shard", "I/N", "I/N, I from 1 to N, or slurm/N for the number in SLURM_ARRAY_TASK_ID",
       "Makes the I-th of N parts of the mesh, in a file beside OUT, for join; a part that is "
       "there "
       "already is not made again",
       " tessellate "},
      {"--shard-patches", "N", "1 or more",
       "For simdbezier-mpi: how many patches a process works on at a time (default 65536)",
       " tessellate "},
      {"--remove-parts", "", "", "Removes the parts when the mesh is in its place", " join "},
      {"-o", "OUT", "a name that ends in .csv, or - for standard output",
       "Output, required; may be a device or pipe", " evaluate "},
      {"--format", "NAME", patch_format_names(""), "Format of IN, otherwise told by its name", all},
      {"--ignore-trims", "", "", "Reads surfaces as a whole of which curves cut out a part", all},
      {"--knot-tolerance", "T", "a number above 0",
       "Knots of splines that are no further apart, in their own parameter, count as equal", all},
      {"--grid", "N|NUxNV", sides,
       "Samples of every patch (default 16); at most 4097 a direction in one mesh without gaps",
       " tessellate plan "},
      {"--grid", "N|NUxNV", sides, "Samples of every patch (default 16)", " evaluate "}};
  add_resolution(entries);
  add_mesh(entries);
  const Entries rest = {
      {"--samples", "FILE.csv", "the name of a CSV file or - for standard input",
       "Samples instead of a grid, with the header patch,u,v, or patch,x,y with x = 2u-1, y = "
       "2v-1, which results call centred_u and centred_v",
       " evaluate "},
      {"--outputs", "LIST", output_names() + " separated by commas",
       "Columns (default position); they come in the order named here, curvature as four "
       "(gaussian, mean, smaller and larger principal)",
       " evaluate "},
      {"--precision", "TYPE", "f32 or f64",
       "Numbers to compute with (default f32, control points are rounded to float first)", both},
      {"--threads", "N", "1 to " + std::to_string(kMostThreads) + ", or 0 for as many as pay",
       "Threads to compute with (default 0)", both},
      {"--json", "", "", "One JSON object, for machines", " info "},
      {"--version", "", "", "Print the version", " simdbezier "},
      {"--help", "", "", "Print this text",
       " simdbezier tessellate evaluate info convert plan join ", "-h"}};
  entries.insert(entries.end(), rest.begin(), rest.end());
  return entries;
}

} // namespace

const std::vector<OptionEntry>& option_entries() {
  static const std::vector<OptionEntry> entries = make_entries();
  return entries;
}

} // namespace simdbezier::tools
