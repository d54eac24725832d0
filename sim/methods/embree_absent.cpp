#include "sim/methods/embree.hpp"

namespace ridgeline::sim {

std::unique_ptr<Method> make_embree(const MethodSpec&, std::string& problem) {
  problem = "embree is absent: this build found no Embree 3";
  return nullptr;
}

}  // namespace ridgeline::sim
