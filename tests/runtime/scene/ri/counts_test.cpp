// tests/runtime/scene/ri/counts_test.cpp: wrong counts and indices in every primitive, in bounded
// memory.
#include <limits>
#include <random>

#include "tests/fuzz_settings.h"
#include "tests/runtime/player/live_memory.h"
#include "tests/runtime/scene/ri/rib_scene.h"

namespace kinora::ri {
namespace {

// What stands between two | is changed: whole numbers, in brackets or not.
constexpr const char* kPrimitives[] = {
    R"(GeneralPolygon |[4 3]| "P" [0 0 1 4 0 1 4 4 1 0 4 1 1 1 1 2 1 1 1 2 1])",
    R"(PointsPolygons |[3 3] [0 1 2 0 2 3]| "P" [0 0 1 1 0 1 1 1 1 0 1 1] "Cs" [1 0 0 0 1 0 0 0 1 1 1 1])",
    R"(PointsGeneralPolygons |[2 1] [3 3 3] [0 1 2 3 4 5 0 2 1]| "P" [0 0 1 9 0 1 9 9 1 3 1 1 4 1 1 4 2 1])",
    R"(PointsPolygons |[4] [0 1 2 3]| "P" [0 0 1 1 0 1 1 1 1 0 1 1] "facevarying float[2] st" [0 0 1 0 1 1 0 1])",
    R"(SubdivisionMesh "catmull-clark" |[4 3] [0 1 2 3 1 4 2]| ["interpolateboundary" "crease"] |[1 0 3 1] [1 0 1 2]| [2] "P" [0 0 1 1 0 1 1 1 1 0 1 1 2 0 1])",
    R"(PatchMesh "bilinear" |3| "nonperiodic" |2| "periodic" "P" [0 0 1 1 0 1 2 0 1 0 1 1 1 1 1 2 1 1])",
    R"(PatchMesh "bicubic" |3| "periodic" |4| "nonperiodic" "Pz" [0 0 0 1 1 1 0 0 0 1 1 1])",
    R"(Basis "b-spline" |1| "catmull-rom" |1| PatchMesh "bicubic" |4| "nonperiodic" |5| "periodic" "Pz" [0 0 0 0 1 1 1 1 0 0 0 0 1 1 1 1 0 0 0 0])",
    R"(NuPatch |2 2| [0 0 1 1] 0 1 |2 2| [0 0 1 1] 0 1 "P" [0 0 1 1 0 1 0 1 1 1 1 1])",
    R"(TrimCurve |[1] [2]| [0 0 1 2 2] [0] [2] |[3]| [.1 .9 .5] [.1 .1 .9] [1 1 1] NuPatch |2 2| [0 0 1 1] 0 1 |2 2| [0 0 1 1] 0 1 "Pw" [0 0 1 1 1 0 1 1 0 1 1 1 1 1 1 1])",
    R"(Curves "cubic" |[4 7]| "nonperiodic" "P" [0 0 1 1 0 1 2 0 1 3 0 1 0 1 1 1 1 1 2 1 1 3 1 1 4 1 1 5 1 1 6 1 1] "constantwidth" [.1])",
    R"(Blobby |2 [1001 0 1003 0 16 0 2 0 1]| [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0] [""])",
    R"(ColorSamples [1 0 0 0 1 0] [1 0 0 0 1 0] Color [.1 .2])",
    R"(ObjectBegin |1| PointsPolygons |[3] [0 1 2]| "P" [0 0 1 1 0 1 1 1 1] ObjectEnd ObjectInstance |1| Illuminate |1 1|)",
};

class WrongNumbers {
  public:
    explicit WrongNumbers(uint64_t seed) : random_(uint32_t(seed % 2147483646 + 1)) {}

    // About one of four whole numbers between bars becomes a wrong one, is left out, or is doubled.
    std::string next() {
        const std::string from = kPrimitives[below(int(std::size(kPrimitives)))];
        std::string made;
        bool inside = false;
        for (size_t i = 0; i < from.size();) {
            if (from[i] == '|') {
                inside = !inside, ++i;
                continue;
            }
            size_t end = inside ? from.find_first_not_of("0123456789", i) : i;
            end = std::min(end, from.size());
            if (end == i) {
                made += from[i++];
                continue;
            }
            made += changed(from.substr(i, end - i));
            i = end;
        }
        return made;
    }

  private:
    int below(int count) { return int(random_() % uint32_t(count)); }
    std::string changed(const std::string& number) {
        constexpr int64_t kWrong[] = {-1,
                                      0,
                                      1,
                                      7,
                                      100,
                                      65'536,
                                      100'000,
                                      2'000'000,
                                      1'431'655'766,
                                      2'147'483'647,
                                      -2'147'483'648,
                                      4'294'967'296};
        switch (below(12)) {
            case 0:
                return "";
            case 1:
                return number + ' ' + number;
            case 2:
                return std::to_string(kWrong[below(int(std::size(kWrong)))]);
            default:
                return number;
        }
    }

    std::minstd_rand random_;
};

void expect_sound(const std::string& primitives) {
    const std::string text = kSmall + "WorldBegin Surface \"constant\" AttributeBegin " +
                             primitives +
                             " AttributeEnd Translate 0 0 2 Sphere 1 -1 1 360 WorldEnd";
    most_live_memory();
    const size_t before = live_memory();
    const RibWorlds read(text);
    EXPECT_LT(most_live_memory() - before, 20 * text.size() + (64u << 20)) << primitives;
    ASSERT_EQ(read.worlds.size(), 1u) << primitives;
    ASSERT_FALSE(read.world().meshes.empty()) << primitives;
    for (const MeshDefinition& mesh : read.world().meshes)
        for (const PrimitiveGroup& group : mesh.groups)
            for (uint32_t corner : group.triangles)
                ASSERT_LT(corner, mesh.positions.size()) << primitives;
    expect_near(read.primitives().back().place({}), {0, 0, 2});
    EXPECT_EQ(read.count("INTERNAL_CHECK"), 0) << primitives << read.findings();
}

TEST(RiCounts, SoundOnesHaveNoFindings) {
    for (std::string primitive : kPrimitives) {
        std::erase(primitive, '|');
        RibWorlds read(kSmall + "LightSource \"ambientlight\" 1 WorldBegin " + primitive +
                       " WorldEnd");
        EXPECT_EQ(
            read.count("RI_COUNTS") + read.count("RIB_PARAMETER_LENGTH") + read.count("RIB_SYNTAX"),
            0)
            << read.findings();
    }
}

TEST(RiCounts, WrongOnesKeepToTheirPrimitive) {
    const uint64_t count = fuzz_setting("KINORA_FUZZ_RIB_COUNTS", 4000);
    for (uint64_t seed : {uint64_t(1), fresh_seed()}) {
        WrongNumbers wrong(seed);
        for (uint64_t i = 0; i < count; ++i)
            ASSERT_NO_FATAL_FAILURE(expect_sound(wrong.next())) << seed << ' ' << i;
    }
}

}  // namespace
}  // namespace kinora::ri
