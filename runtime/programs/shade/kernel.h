// runtime/programs/shade/kernel.h: shaders with values for their parameters, compiled and
// run over a patch.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "rsl/compile.h"
#include "rsl/lower/lower.h"
#include "runtime/base/arena.h"
#include "runtime/programs/shade/patch_host.h"
#include "runtime/programs/shade/source.h"
#include "runtime/scene/kernels/bound_kernel.h"

namespace kinora {

// The stack to run, bound: a displacement gets a matte surface over it to be seen.
struct ShadeStack {
    std::vector<rsl::Layer> layers;
    std::map<rsl::KernelKey, float> values;  // parameters
    rsl::LowerOptions lower;
    bool light = false;
    bool derivatives = true;  // false: all that Du, Dv and filters' widths rest on is 0
    std::vector<std::shared_ptr<const rsl::Shader>> library;  // keeps the matte
};

// Reads and compiles the source, chooses the shader, puts the patch before a light, binds the
// effect's and the user's parameters and chooses the outputs. Returns an exit code (said on stderr)
// when the command ends here; the shader is the stack's first layer.
std::optional<int> open_stack(const ShadeOptions& options, ShadeSource& source, Patch& patch,
                              ShadeStack& stack);

// "lamps.2": element 2 of the output parameter lamps; of one that is no array -1.
std::pair<std::string, int> output_element(const std::string& output);

// The part of it that binds: 0, or the exit code of unknown or ill-formed parameters and outputs.
int bind_stack(const ShadeOptions& options, const ShadeSource& source, const rsl::Shader& shader,
               const Patch& patch, ShadeStack& stack);

// Outputs of a run by kernel output name: one value a point of the patch.
using ShadeOutputs = std::map<std::string, std::vector<float>>;

class ShadeKernel {
  public:
    // Lowers and compiles; findings go to the source's diagnostics. False if lowering failed.
    bool compile(const ShadeStack& stack, const jit::Target* target, Diagnostics& diagnostics,
                 std::vector<std::pair<std::string, std::string>>* dumps = nullptr);
    // Prepares the columns; the kernel then runs over all points any number of times.
    void bind(const ShadeStack& stack, const Patch& patch);
    void run();
    // Of the last run; ints as their values.
    ShadeOutputs outputs() const;
    // What a light gives a white matte patch, as Ci.
    ShadeOutputs illumination() const;
    // Coordinate systems that the shader names and no scene gives: here they are the world.
    std::vector<std::string> unknown_spaces() const;
    // Of the last run: a finding for each location in the shader that reported a fault, and one
    // where it printed more than a shader may.
    void report_faults(Diagnostics& diagnostics) const;

    const rsl::LoweredShader& lowered() const { return lowered_; }
    const jit::KernelPair& pair() const { return bound_.pair; }
    double lower_ms = 0;

  private:
    void fill_records();
    float* column(size_t count, float value);

    rsl::LoweredShader lowered_;
    BoundKernel bound_;
    FrameBlock frame_;
    const ShadeStack* stack_ = nullptr;
    const Patch* patch_ = nullptr;
    Arena arena_;
    std::span<float*> columns_, out_;
    std::vector<uint8_t> faults_;
    PrintedLines prints_;
    std::vector<jit::Record> records_;
    jit::RecordSet record_sets_[kPatchRecordSets];
};

}  // namespace kinora
