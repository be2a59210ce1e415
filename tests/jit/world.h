// tests/jit/world.h: the inputs, services and record sets that random programs run against.
#pragma once

#include <map>
#include <string>

#include "tests/jit/run_kernel.h"

namespace kinora::jit::test {

// Positions in the inputs that declare_world makes.
inline constexpr int kArrayInputs = 3;
inline constexpr int kPointArray = 6;
inline constexpr int kFrameArray = 9;
inline constexpr int kRecordSets = 3;  // set 0 has no records
inline constexpr int kRecordFields = 2;

// Adds the world's inputs and services to an empty module.
void declare_world(Module& module);

// Values for everything by name, so that kernels with fewer inputs run on the same world.
class World {
  public:
    World(uint64_t seed, int32_t count);

    // Runs a kernel that reads all inputs itself. A log of impure service calls joins the result.
    RunResult run(const Kernel& kernel);
    // Runs the frame kernel (may be null), then the point kernel on its frame block.
    RunResult run_pair(const Kernel* frame, const Kernel& point);

    int32_t count() const { return count_; }

  private:
    RunResult run_with(const Kernel& kernel, int32_t count, std::vector<int32_t> frame);

    int32_t count_;
    std::map<std::string, std::vector<int32_t>> inputs_;
    std::vector<AlignedFloats> columns_;
    std::vector<float> uniforms_;
    std::vector<const float*> column_pointers_;
    std::vector<Record> records_;
    std::vector<RecordSet> sets_;
};

}  // namespace kinora::jit::test
