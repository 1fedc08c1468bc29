#include <tools/mpi/rank_stats.hpp>

#include <cstdio>
#include <vector>

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

double peak_bytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

} // namespace

void print_rank_stats(const Ranks& ranks, const Arguments& arguments, MeshStats stats,
                      std::uint64_t written) {
  const StageSeconds& s = stats.seconds;
  const std::vector<double> own = {s.read,
                                   s.pack,
                                   s.rates,
                                   s.topology,
                                   s.evaluate,
                                   s.write,
                                   peak_bytes(),
                                   static_cast<double>(ranks.sent()),
                                   static_cast<double>(written)};
  const std::vector<double> all = ranks.gather(own);
  for (std::uint64_t* const count : {&stats.vertices, &stats.triangles, &stats.samples}) {
    *count = ranks.sum(*count);
  }
  std::size_t joined[2] = {stats.joined ? stats.joined->turned_edges : 0,
                           stats.joined ? stats.joined->repeated_patches : 0};
  for (std::size_t* const count :
       {&stats.patches, &stats.open_edges, &stats.non_manifold_edges, &joined[0], &joined[1]}) {
    *count = ranks.sum(*count);
  }
  stats.deviation = ranks.most(stats.deviation);
  stats.diagonal = ranks.most(stats.diagonal);
  if (!ranks.is_first() || arguments.mesh.stats == StatsForm::none) {
    return;
  }
  if (stats.joined) {
    stats.joined->turned_edges = joined[0];
    stats.joined->repeated_patches = joined[1];
  }
  if (arguments.mesh.stats == StatsForm::text) {
    std::fputs(stats_as_text(stats).c_str(), stderr);
    return;
  }
  auto json = nlohmann::ordered_json::parse(stats_as_json(stats));
  json.erase("orientable"); // which no rank knows
  json["ranks"] = nlohmann::ordered_json::array();
  for (std::size_t at = 0; at < all.size(); at += own.size()) {
    const double* const v = &all[at];
    json["ranks"].push_back({{"seconds",
                              {{"read", v[0]},
                               {"pack", v[1]},
                               {"rates", v[2]},
                               {"topology", v[3]},
                               {"evaluate", v[4]},
                               {"write", v[5]}}},
                             {"memory", v[6]},
                             {"sent", v[7]},
                             {"written", v[8]}});
  }
  OutputFile out("-");
  out.text(json.dump(2) + "\n");
  out.commit();
}

} // namespace simdbezier::tools
