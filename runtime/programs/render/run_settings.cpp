// runtime/programs/render/run_settings.cpp: settings that a run chooses or measures.
#include "runtime/programs/render/run.h"

#include <utility>

#include "runtime/picture/trade/variants.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/render/fingerprint.h"
#include "runtime/programs/render/stop_signal.h"
#include "runtime/programs/tradeoff/asserts.h"
#include "runtime/programs/tradeoff/tradeoff.h"

namespace kinora {

void Render::tell_target(const std::string& text) const {
    if (!text.empty() && !options_.findings.quiet)
        std::fprintf(stderr, "kinora-render: %s\n", text.c_str());
}

// An error's settings are those of the shot, so that a frame has the same ones in each part of it.
FrameTimes Render::frames_to_probe() const {
    if (options_.frame_target.ms > 0) return list_;
    const SceneOptions& played = scene_.scene().options;
    FrameTimes middle = middle_of_shot(options_, scene_.rate(), played.start_time, played.end_time);
    if (!middle.empty()) return middle;
    tell_target(target_text(options_.frame_target) +
                ": the scene plays without end, so the frames given here choose the settings; "
                "give all frames of the shot, or --quality");
    return list_;
}

// Chooses settings and builds the scene with them, where it was built with others.
int Render::choose_settings_for_target() {
    std::string why_not;
    const FrameTimes probed = frames_to_probe();
    auto chosen = choose_settings({.scene = options_,
                                   .imported = *scene_.imported(),
                                   .frames = probed,
                                   .target = options_.frame_target,
                                   .fixed = options_.fixed_settings,
                                   .measured = options_.measured,
                                   .fingerprint = scene_fingerprint(),
                                   .stop = &g_signal},
                                  scene_.diagnostics(), why_not);
    flush_findings();
    if (g_signal) return 128 + g_signal;
    if (!chosen) {
        std::fprintf(stderr, "kinora-render: error: %s: %s\n",
                     target_text(options_.frame_target).c_str(), why_not.c_str());
        return kExitSomeFailed;
    }
    targeted_.emplace(options_.frame_target, *chosen);
    tell_target(targeted_->begin_text());
    options_.quality = chosen->quality;
    scene_.set_quality(options_.quality);
    if (scene_key(asked_.quality) == scene_key(options_.quality)) return kExitOk;
    scene_.keep(OpenScene::Keep::Nothing);
    const size_t known = scene_.diagnostics().findings().size();
    scene_.build();
    scene_.diagnostics().drop_repeats(known);
    return scene_.is_built() ? int(kExitOk) : report_unreadable();
}

bool Render::choose_samples(int64_t frame, double time, const raytrace::Progress& progress) {
    SceneRequest seeded = options_;
    auto pass = [&](int samples, uint32_t seed, raytrace::Film& film) {
        FrameSettings settings = scene_.settings();
        settings.integrator.samples_per_pixel = samples;
        seeded.seed = options_.seed + seed;
        settings.integrator.seed = frame_seed(seeded, frame);
        settings.most_dice_error = 0;
        FrameStats stats;
        const size_t known = scene_.diagnostics().findings().size();
        bool whole = render_frame(scene_.scene(), scene_.pose(), time, settings, film, stats,
                                  scene_.diagnostics(), &progress);
        scene_.diagnostics().drop_repeats(known);
        return whole;
    };
    scene_.settings().integrator.samples_per_pixel = targeted_->samples(pass);
    return scene_.settings().integrator.samples_per_pixel > 0;
}

// Worlds of a film have its texts first.
void Render::hash_scene() {
    KnownHashes own;
    scene_hash_ =
        hash_inputs(scene_.diagnostics().files, *scene_.scene().description, options_.scene,
                    world_ ? world_->hashes : own, world_ ? world_->found.files.count() : 0);
}

// Of the scene and what its pictures depend on besides knobs and frames.
std::string Render::scene_fingerprint() const {
    RenderOptions plain = asked_;
    plain.quality = *find_quality(kDefaultQuality);
    plain.frame_target = {};
    return fingerprint(plain, scene_hash_, options_.width, options_.height, scene_.rate().value(),
                       0);
}

int Render::tradeoff() {
    std::vector<TradeAssert> asserts;
    for (const std::string& text : options_.asserts) {
        std::string error;
        std::optional<TradeAssert> parsed = parse_trade_assert(text, error);
        if (!parsed) {
            std::fprintf(stderr, "kinora-render: --assert: %s\n", error.c_str());
            return kExitUsage;
        }
        asserts.push_back(std::move(*parsed));
    }
    if (int code = try_tradeoff_folder(options_.tradeoff)) return code;
    catch_signals();
    if (!list_frames()) return kExitUsage;
    hash_scene();
    std::string print = scene_fingerprint();
    scene_.close();  // its memory is for the scenes to come
    TradeResults results;
    bool measured = measure_tradeoff({.scene = options_,
                                      .imported = *scene_.imported(),
                                      .frames = std::exchange(list_, {}),
                                      .fingerprint = std::move(print),
                                      .budget_s = options_.budget,
                                      .tell = !options_.findings.quiet,
                                      .stop = &g_signal},
                                     scene_.diagnostics(), results);
    flush_findings();
    if (g_signal) return 128 + g_signal;
    if (!measured) return kExitSomeFailed;
    std::fputs(tradeoff_text(results).c_str(), stdout);
    if (int code = write_tradeoff(results, options_.tradeoff)) return code;
    std::vector<std::string> broken = broken_asserts(results, asserts);
    for (const std::string& text : broken)
        std::fprintf(stderr, "kinora-render: error: --assert %s\n", text.c_str());
    return broken.empty() ? kExitOk : kExitSomeFailed;
}

}  // namespace kinora
