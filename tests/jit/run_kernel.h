// tests/jit/run_kernel.h: runs a kernel on plain vectors, with all that a KernelCall needs laid
// out.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "jit/ir/kernel_call.h"

namespace kinora::jit::test {

struct AlignedFloats {
    explicit AlignedFloats(size_t count) : size(count) {
        void* p = nullptr;
        if (posix_memalign(&p, 64, (count + kMaxLanes) * sizeof(float)) != 0) std::abort();
        data = static_cast<float*>(p);
        std::memset(p, 0, (count + kMaxLanes) * sizeof(float));
    }
    ~AlignedFloats() { free(data); }
    AlignedFloats(AlignedFloats&& other) noexcept : data(other.data), size(other.size) {
        other.data = nullptr;
    }
    AlignedFloats& operator=(AlignedFloats&&) = delete;
    float* data;
    size_t size;
};

// What a run gave: bits of each output at each point, the fault bytes, and whatever a test's
// services noted for each point.
struct RunResult {
    std::vector<std::vector<int32_t>> out;
    std::vector<uint8_t> fault;
    std::vector<uint64_t> log;
    bool operator==(const RunResult&) const = default;
};

// What a run is given. inputs[k][point]; short rows are an error.
struct RunInput {
    int32_t count = 1;
    std::vector<std::vector<int32_t>> inputs;
    std::vector<int32_t> frame;
    std::vector<ServiceFn> services;
    const RecordSet* record_sets = nullptr;
    void* grid = nullptr;
    const std::atomic<int>* stop = nullptr;
};

inline RunResult run_kernel(const Kernel& kernel, const RunInput& input) {
    auto points = static_cast<size_t>(input.count);
    std::vector<AlignedFloats> rows;
    std::vector<const float*> in;
    std::vector<float*> out;
    rows.reserve(kernel.inputs.size() + kernel.outputs.size());
    for (size_t k = 0; k < kernel.inputs.size(); ++k) {
        AlignedFloats& row = rows.emplace_back(padded(points));
        for (size_t p = 0; p < row.size; ++p) {
            size_t point = std::min(p, points - 1);
            std::memcpy(row.data + p, &input.inputs[k][point], sizeof(float));
        }
        in.push_back(row.data);
    }
    for (size_t k = 0; k < kernel.outputs.size(); ++k)
        out.push_back(rows.emplace_back(padded(points)).data);
    AlignedFloats frame(input.frame.size());
    if (!input.frame.empty())
        std::memcpy(frame.data, input.frame.data(), input.frame.size() * sizeof(float));
    AlignedFloats scratch(kernel.scratch_bytes / sizeof(float));
    RunResult result;
    result.fault.assign(kernel.fault_sites.size(), 0);
    KernelCall{.kernel = kernel,
               .count = points,
               .in = in,
               .out = out,
               .row_floats = padded(points),
               .frame = {frame.data, frame.size},
               .scratch = {reinterpret_cast<std::byte*>(scratch.data), kernel.scratch_bytes},
               .faults = result.fault,
               .services = input.services,
               .record_sets = {input.record_sets, input.record_sets ? 1u : 0u},
               .host = input.grid,
               .stop = input.stop}
        .run();
    for (float* row : out) {
        auto& bits = result.out.emplace_back(points);
        std::memcpy(bits.data(), row, bits.size() * sizeof(float));
    }
    return result;
}

// Equal bits, or both NaN where the output is a float.
inline bool same_bits(int32_t a, int32_t b, Type type) {
    if (a == b) return true;
    float fa = float_of(a), fb = float_of(b);
    return type == Type::F && fa != fa && fb != fb;
}

// "" if equal; else which output, point and values differ.
inline std::string difference(const Kernel& kernel, const RunResult& a, const RunResult& b) {
    for (size_t k = 0; k < a.out.size(); ++k)
        for (size_t p = 0; p < a.out[k].size(); ++p)
            if (!same_bits(a.out[k][p], b.out[k][p], kernel.outputs[k].type)) {
                char text[200];
                snprintf(text, sizeof text, "output %s point %zu: %08x (%g) against %08x (%g)",
                         kernel.outputs[k].name.c_str(), p, unsigned(a.out[k][p]),
                         double(float_of(a.out[k][p])), unsigned(b.out[k][p]),
                         double(float_of(b.out[k][p])));
                return text;
            }
    for (size_t k = 0; k < a.fault.size(); ++k)
        if (a.fault[k] != b.fault[k]) return "fault " + std::to_string(k) + " differs";
    for (size_t p = 0; p < a.log.size(); ++p)
        if (a.log[p] != b.log[p]) return "service calls of point " + std::to_string(p) + " differ";
    return "";
}

}  // namespace kinora::jit::test
