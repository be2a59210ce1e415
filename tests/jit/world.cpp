// tests/jit/world.cpp: random and edge inputs, services with and without memory, records.
#include "tests/jit/world.h"

#include <cmath>
#include <random>

#include "tests/jit/random_module.h"

namespace kinora::jit::test {

namespace {

// What impure services were asked, folded to one number a point, and how often beyond the points.
struct CallLog {
    std::vector<uint64_t> points;
    uint64_t beyond = 0;
};

uint64_t mix(uint64_t h, uint64_t word) {
    h ^= word + 0x9e3779b97f4a7c15u + (h << 6) + (h >> 2);
    return h * 0xff51afd7ed558ccdu;
}

// Every NaN alike.
uint32_t plain_bits(float value) {
    return std::isnan(value) ? 0x7fc00000u : static_cast<uint32_t>(bits_of(value));
}

void service_mix(const ServiceCall& call) {
    for (int k = 0; k < kMaxLanes; ++k) {
        if ((call.mask >> k & 1) == 0) continue;
        float x = call.args[k];
        auto n = static_cast<uint32_t>(bits_of(call.args[kMaxLanes + k]));
        call.results[k] = std::isnan(x) ? 1.0f : x * 0.5f + 1.0f;
        call.results[kMaxLanes + k] = float_of(static_cast<int32_t>(n * 3 + 1));
    }
}

void service_log(const ServiceCall& call) {
    auto& log = *static_cast<CallLog*>(call.grid);
    log.beyond += call.mask == 0;  // nobody asks: no call
    for (int k = 0; k < kMaxLanes; ++k) {
        if ((call.mask >> k & 1) == 0) continue;
        auto point = static_cast<size_t>(call.first + k);
        if (point >= log.points.size()) {  // a padding lane
            ++log.beyond;
            continue;
        }
        uint64_t& word = log.points[point];
        word = mix(word, plain_bits(call.args[k]));
        word = mix(word, static_cast<uint32_t>(bits_of(call.args[kMaxLanes + k])));
        call.results[k] = float_of(static_cast<int32_t>(word & 0xff));
    }
}

const ServiceInfo kServices[] = {
    {"mix", {Type::F, Type::I}, {Type::F, Type::I}, true},
    {"log", {Type::F, Type::I}, {Type::I}, false},
};
constexpr ServiceFn kServiceFns[] = {service_mix, service_log};

ServiceFn find_service(const std::string& name) {
    for (size_t k = 0; k < std::size(kServices); ++k)
        if (kServices[k].name == name) return kServiceFns[k];
    return nullptr;
}

}  // namespace

void declare_world(Module& module) {
    auto add = [&](const char* name, Type type, Rate rate) {
        module.inputs.push_back({name, type, rate, "", ""});
    };
    add("p0", Type::F, Rate::Point);
    add("p1", Type::F, Rate::Point);
    add("i0", Type::I, Rate::Point);
    add("f0", Type::F, Rate::Frame);
    add("f1", Type::F, Rate::Frame);
    add("n0", Type::I, Rate::Frame);
    for (const char* name : {"pa0", "pa1", "pa2"}) add(name, Type::F, Rate::Point);
    for (const char* name : {"fa0", "fa1", "fa2"}) add(name, Type::I, Rate::Frame);
    for (int k = 0; k < 24; ++k) module.table.push_back(kEdgeFloats[k % kEdgeFloatCount]);
    module.services.assign(std::begin(kServices), std::end(kServices));
}

World::World(uint64_t seed, int32_t count) : count_(count) {
    std::mt19937_64 rng(seed);
    auto below = [&](int n) { return static_cast<int>(rng() % static_cast<uint64_t>(n)); };
    Module module;
    declare_world(module);
    for (const InputInfo& input : module.inputs) {
        std::vector<int32_t>& row = inputs_[input.name];
        for (int32_t p = 0; p < count; ++p) {
            bool edge = below(3) == 0;
            int32_t bits = input.type == Type::F
                               ? bits_of(edge ? kEdgeFloats[below(kEdgeFloatCount)]
                                              : static_cast<float>(below(4001) - 2000) / 128.0f)
                           : edge ? kEdgeInts[below(kEdgeIntCount)]
                                  : below(12) - 3;
            row.push_back(input.rate == Rate::Frame && p > 0 ? row[0] : bits);
        }
    }
    uniforms_ = {0.25f, -3.0f, 7.5f, 0.0f, 1e30f, -0.0f};
    constexpr int kRecords = 3;
    column_pointers_.reserve(kRecords * kRecordFields);
    for (int r = 0; r < kRecords; ++r) {
        for (int field = 0; field < kRecordFields; ++field) {
            AlignedFloats& column = columns_.emplace_back(padded(count));
            for (size_t p = 0; p < column.size; ++p)
                column.data[p] = static_cast<float>(below(1000)) / 8.0f;
            column_pointers_.push_back(column.data);
        }
        records_.push_back(
            {column_pointers_.data() + r * kRecordFields, uniforms_.data() + r * kRecordFields});
    }
    sets_ = {{0, nullptr}, {1, &records_[0]}, {2, &records_[1]}};
}

RunResult World::run_with(const Kernel& kernel, int32_t count, std::vector<int32_t> frame) {
    RunInput input;
    input.count = count;
    input.frame = std::move(frame);
    for (const InputInfo& info : kernel.inputs) input.inputs.push_back(inputs_.at(info.name));
    for (const ServiceInfo& info : kernel.services)
        input.services.push_back(find_service(info.name));
    input.record_sets = sets_.data();
    CallLog log{std::vector<uint64_t>(static_cast<size_t>(count), 0)};
    input.grid = &log;
    RunResult result = run_kernel(kernel, input);
    result.log = std::move(log.points);
    result.log.push_back(log.beyond);
    return result;
}

RunResult World::run(const Kernel& kernel) {
    return run_with(kernel, count_, {});
}

RunResult World::run_pair(const Kernel* frame, const Kernel& point) {
    std::vector<int32_t> block;
    std::vector<uint8_t> faults;
    if (frame != nullptr) {
        RunResult slots = run_with(*frame, 1, {});
        for (const auto& row : slots.out) block.push_back(row[0]);
        faults = slots.fault;
    }
    RunResult result = run_with(point, count_, block);
    for (size_t k = 0; k < faults.size(); ++k) result.fault[k] |= faults[k];
    return result;
}

}  // namespace kinora::jit::test
