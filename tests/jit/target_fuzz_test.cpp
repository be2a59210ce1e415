// tests/jit/target_fuzz_test.cpp: random modules give the same bits on every target and interp, and
// their register allocations are proven. KINORA_FUZZ=N runs N programs of each kind instead.
#include <gtest/gtest.h>

#include <cstdlib>

#include "jit/interp/interp.h"
#include "jit/target.h"
#include "tests/jit/run_kernel.h"
#include "tests/jit/target_random.h"

namespace kinora::jit {
namespace {

using test::RunInput;

// Results depend on the point and the arguments of asking lanes only.
void mix_service(const ServiceCall& call) {
    for (int lane = 0; lane < call.lanes; ++lane) {
        if ((call.mask >> lane & 1) == 0) continue;
        auto bits = [&](int k) {
            return static_cast<uint32_t>(bits_of(call.args[k * kMaxLanes + lane]));
        };
        float x = call.args[lane];
        call.results[lane] = x * 0.5f + static_cast<float>((call.first + lane) & 3);
        call.results[kMaxLanes + lane] = float_of(static_cast<int32_t>(bits(1) * 3 + 1));
    }
}

struct Data {
    explicit Data(uint32_t seed) : random(seed) {
        for (auto& field : columns)
            for (float& x : field) x = static_cast<float>(random() % 1000) / 8;
        for (int r = 0; r < test::kRecords; ++r) {
            for (int f = 0; f < test::kFields; ++f) pointers[r][f] = columns[r * 3 + f];
            records[r] = {pointers[r], columns[r]};
        }
        sets[0] = {test::kRecords, records};
        sets[1] = {seed % 2 == 0 ? 0 : 2, records};
    }

    int32_t any_bits() {
        const float floats[] = {0, -0.0f, 1, -1, 1e-40f, -1e38f, INFINITY, NAN, 0.1f, 1e9f};
        if (random() % 4 == 0) return bits_of(floats[random() % 10]);
        return bits_of((static_cast<float>(random() % 20001) - 10000) / 64);
    }

    RunInput input(int32_t count) {
        RunInput in;
        in.count = count;
        for (int k = 0; k < test::kFloatInputs + test::kIntInputs; ++k) {
            auto& row = in.inputs.emplace_back();
            for (int p = 0; p < count; ++p)
                row.push_back(k < test::kFloatInputs ? any_bits()
                                                     : static_cast<int32_t>(random() % 16) - 4);
        }
        for (int k = 0; k < test::kFrameSlots; ++k) in.frame.push_back(any_bits());
        in.record_sets = sets;
        return in;
    }

    std::mt19937 random;
    alignas(64) float columns[9][64];
    const float* pointers[3][3];
    Record records[3];
    RecordSet sets[2];
};

// "" or what went wrong.
std::string compare(const Module& module, uint32_t seed, const Target& target) {
    auto reference = emit_interp(module, nullptr);
    auto kernel = target.emit(module, nullptr);
    Data data(seed);
    auto count = static_cast<int32_t>(1 + seed % 40);
    RunInput input = data.input(count);
    input.services.assign(module.services.size(), mix_service);  // none where nothing calls it
    auto expected = run_kernel(*reference, input);
    auto got = run_kernel(*kernel, input);
    return difference(*kernel, expected, got);
}

void fuzz(int programs, int ops, bool calls, uint32_t first_seed) {
    if (const char* many = std::getenv("KINORA_FUZZ")) programs = std::atoi(many);
    if (const char* first = std::getenv("KINORA_SEED"))
        first_seed = static_cast<uint32_t>(std::atoi(first));
    for (int k = 0; k < programs; ++k) {
        uint32_t seed = first_seed + static_cast<uint32_t>(k);
        Module module = test::random_target_module(seed, ops, calls);
        ASSERT_EQ(verify(module), "") << "seed " << seed;
        for (const Target& target : targets()) {
            if (target.check == nullptr) continue;
            ASSERT_EQ(target.check(module), "") << target.name << ", seed " << seed << "\n"
                                                << print(module);
            if (!target.supported()) continue;
            ASSERT_EQ(compare(module, seed, target), "")
                << "seed " << seed << " ops " << ops << " calls " << calls << " " << target.name
                << "\n"
                << print(module);
        }
    }
}

TEST(TargetModules, SmallProgramsEqualTheInterpreter) {
    fuzz(2000, 12, false, 1);
}
TEST(TargetModules, ProgramsEqualTheInterpreter) {
    fuzz(2000, 60, false, 100'000);
}
TEST(TargetModules, ProgramsWithCallsEqualTheInterpreter) {
    fuzz(2000, 60, true, 200'000'000);
}
TEST(TargetModules, LongProgramsEqualTheInterpreter) {
    fuzz(100, 600, true, 400'000'000);
}

}  // namespace
}  // namespace kinora::jit
