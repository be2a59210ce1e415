// tests/runtime/scene/images/texture_bench.cpp: lookups a second, ours and OpenImageIO's per-lookup
// call.
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>

#include "tests/runtime/scene/images/texture_lookup.h"

namespace kinora {
namespace {

constexpr int kLanes = jit::kMaxLanes, kSize = 1024, kGroups = 4096;

TextureImage picture() {
    return byte_image(kSize, kSize, [](int x, int y) { return (x * 31 + y * 17) & 255; });
}

// 16 neighbours along a slanted row; footprints are texels * stretch long and texels wide.
struct Walk {
    alignas(64) float rows[11][kLanes] = {};
    void step(int group, float texels, float stretch) {
        for (int i = 0; i < kLanes; ++i) {
            float k = float(group * kLanes + i);
            rows[1][i] = k * texels / kSize;
            rows[2][i] = k * texels * 0.37f / kSize;
            rows[3][i] = texels * stretch / kSize;
            rows[6][i] = texels / kSize;
            rows[8][i] = rows[9][i] = 1;
        }
    }
};

void ours(benchmark::State& state) {
    TexturePyramid pyramid(picture(), true);
    TextureName modes;
    Walk walk;
    float texels = float(state.range(0)), stretch = float(state.range(1));
    alignas(64) float results[4][kLanes];
    int group = 0;
    for (auto _ : state) {
        walk.step(group, texels, stretch);
        group = (group + 1) % kGroups;
        auto& r = walk.rows;
        sample_texture(
            pyramid, modes, TextureFilter::Anisotropic, 0xffff,
            {r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8], r[9], r[10], results[0]});
        benchmark::DoNotOptimize(results);
    }
    state.SetItemsProcessed(state.iterations() * kLanes);
}

void openimageio(benchmark::State& state) {
    std::string path = (std::filesystem::temp_directory_path() /
                        ("kinora_bench_" + std::to_string(getpid()) + ".tif"))
                           .string();
    TextureImage image = picture();
    auto output = OIIO::ImageOutput::create(path);
    output->open(path, OIIO::ImageSpec(kSize, kSize, 4, OIIO::TypeDesc::UINT8));
    output->write_image(OIIO::TypeDesc::UINT8, image.bytes.data());
    output->close();
    OIIO::TextureSystem* system = OIIO::TextureSystem::create(false);
    system->attribute("automip", 1);
    system->attribute("autotile", 64);
    auto* thread = system->get_perthread_info();
    auto* handle = system->get_texture_handle(OIIO::ustring(path), thread);
    OIIO::TextureOpt options;
    options.swrap = options.twrap = OIIO::TextureOpt::WrapPeriodic;
    options.interpmode = OIIO::TextureOpt::InterpBilinear;
    options.mipmode = OIIO::TextureOpt::MipModeAniso;
    Walk walk;
    float texels = float(state.range(0)), stretch = float(state.range(1)), rgba[4];
    int group = 0;
    for (auto _ : state) {
        walk.step(group, texels, stretch);
        group = (group + 1) % kGroups;
        auto& r = walk.rows;
        for (int i = 0; i < kLanes; ++i) {
            system->texture(handle, thread, options, r[1][i], r[2][i], r[3][i], 0, 0, r[6][i], 4,
                            rgba);
            benchmark::DoNotOptimize(rgba);
        }
    }
    state.SetItemsProcessed(state.iterations() * kLanes);
    OIIO::TextureSystem::destroy(system);
    std::filesystem::remove(path);
}

// Magnified, minified, and a footprint eight times longer than wide.
#define ROWS ArgNames({"texels", "stretch"})->Args({0, 1})->Args({3, 1})->Args({3, 8})
BENCHMARK(ours)->ROWS;
BENCHMARK(openimageio)->ROWS;

}  // namespace
}  // namespace kinora

BENCHMARK_MAIN();
