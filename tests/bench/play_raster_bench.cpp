// tests/bench/play_raster_bench.cpp: ImGui's demonstration at 1280 x 720, ms a frame.
#include <benchmark/benchmark.h>

#include "runtime/programs/play/raster/raster.h"

namespace kinora::play {
namespace {

void BM_draw_demo(benchmark::State& state, const std::string& kernel) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    Texture font;
    unsigned char* texels;
    io.Fonts->GetTexDataAsAlpha8(&texels, &font.width, &font.height);
    font.texels = texels;
    font.format = TexelFormat::Alpha8;
    io.Fonts->SetTexID(texture_id(&font));
    io.DisplaySize = {1280, 720};
    for (int frame = 0; frame < 3; ++frame) {
        io.DeltaTime = 1.0f / 60;
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({640, 720});
        ImGui::ShowDemoWindow();
        ImGui::SetNextWindowPos({640, 0});
        ImGui::SetNextWindowSize({640, 720});
        ImGui::Begin("style");
        ImGui::ShowStyleEditor();
        ImGui::End();
        ImGui::Render();
    }
    std::vector<uint32_t> pixels(1280 * 720);
    for (auto _ : state) {
        draw(*ImGui::GetDrawData(), {pixels.data(), 1280, 720, 1280}, kernel.c_str());
        benchmark::ClobberMemory();
    }
    ImGui::DestroyContext();
}

// A picture of half the size, filtered up to the whole window.
void BM_draw_scaled(benchmark::State& state, const std::string& kernel) {
    std::vector<uint8_t> texels(640 * 360 * 4, 99);
    const Texture texture{texels.data(), 640, 360};
    ImDrawList list(nullptr);
    ImDrawList* lists = &list;
    ImDrawCmd command;
    command.ClipRect = {0, 0, 1280, 720};
    command.TextureId = texture_id(&texture);
    command.ElemCount = 6;
    list.CmdBuffer.push_back(command);
    list.VtxBuffer.push_back({{0, 0}, {0, 0}, IM_COL32_WHITE});
    list.VtxBuffer.push_back({{1280, 0}, {1, 0}, IM_COL32_WHITE});
    list.VtxBuffer.push_back({{1280, 720}, {1, 1}, IM_COL32_WHITE});
    list.VtxBuffer.push_back({{0, 720}, {0, 1}, IM_COL32_WHITE});
    for (ImDrawIdx i : {0, 1, 2, 0, 2, 3}) list.IdxBuffer.push_back(i);
    ImDrawData data;
    data.CmdLists = &lists;
    data.CmdListsCount = 1;
    data.FramebufferScale = {1, 1};
    std::vector<uint32_t> pixels(1280 * 720);
    for (auto _ : state) {
        draw(data, {pixels.data(), 1280, 720, 1280}, kernel.c_str());
        benchmark::ClobberMemory();
    }
}

}  // namespace
}  // namespace kinora::play

int main(int argc, char** argv) {
    for (const std::string& kernel : kinora::play::span_kernels()) {
        benchmark::RegisterBenchmark(("BM_draw_demo/" + kernel).c_str(), kinora::play::BM_draw_demo,
                                     kernel)
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(("BM_draw_scaled/" + kernel).c_str(),
                                     kinora::play::BM_draw_scaled, kernel)
            ->Unit(benchmark::kMillisecond);
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
