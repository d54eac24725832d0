#pragma once
#include <memory>
#include <string>
#include <vector>

#include "sim/bench/bench_row.hpp"
#include "sim/session/session.hpp"

namespace ridgeline::sim {

/// One method as the benchmark draws it.
struct BenchMethod {
  MethodSpec spec;
  FrameSettings settings;    ///< of the frame; for the module's own ways they are the method
  Method* method = nullptr;  ///< kept by the session; null: one of the module's own ways
  std::string own_params;    ///< of those
  std::unique_ptr<BlockBearing> bearing;  ///< kept from frame to frame by those, as in flight

  [[nodiscard]] std::string params() const {
    return method == nullptr ? own_params : std::string(method->params());
  }
};

/// Makes the methods in a session that is open.
/// `tolerant`: a name that this build does not know counts as absent (defaults, papers) instead of
/// being an error.
/// Outcome: which method has which wrong word.
Outcome make_bench_methods(const std::vector<MethodSpec>& specs, bool tolerant, Session& session,
                           std::vector<BenchMethod>& methods, std::vector<AbsentMethod>& absent);

}  // namespace ridgeline::sim
