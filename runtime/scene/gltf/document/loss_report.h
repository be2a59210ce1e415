// runtime/scene/gltf/document/loss_report.h: findings about what glTF cannot hold.
#pragma once

#include <set>
#include <string>

#include "runtime/base/diagnostic.h"

namespace kinora {

class LossReport {
  public:
    explicit LossReport(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    // What nothing in the file keeps; each is reported once.
    void lost(const std::string& what, const std::string& why, Location where = {});
    // What only import_gltf reads back.
    void in_extras(const std::string& what, const std::string& why, Location where = {});
    void hidden(uint32_t nodes);
    // So many curves became straight pieces, at most that far from them.
    void sampled(uint32_t curves, double worst_error);

  private:
    Diagnostics& diagnostics_;
    std::set<std::string> reported_;
};

}  // namespace kinora
