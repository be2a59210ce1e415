// runtime/player/pixel/pixel_story.cpp: one sample of a pixel, shaded again and watched.
#include "runtime/player/pixel/pixel_story.h"

#include "runtime/picture/frame/frame.h"
#include "runtime/player/pixel/explain_point.h"
#include "runtime/player/pixel/ray_recorder.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

constexpr size_t kMostPoints = 8;

}  // namespace

void prepare_stories() {
    watch_launches();
}

PixelStory pixel_story(const Scene& scene, Pose& pose, double time, const FrameSettings& settings,
                       const SourceFiles& files, int x, int y, int sample) {
    PixelStory story;
    story.x = x, story.y = y, story.sample = sample;
    Diagnostics ignored;  // the frames tell them
    FrameStats stats;
    if (x < 0 || y < 0 || x >= settings.width || y >= settings.height) return story;
    if (!pose_frame(scene, pose, time, settings, stats, ignored)) return story;
    raytrace::Film film;
    if (!pose.shading) pose.shading = std::make_shared<Shading>(scene, pose);
    pose.shading->stop_by(settings.stop);
    pose.shading->show(settings.insight);
    pose.shading->begin_frame(settings.integrator.seed, settings.integrator.max_layers, true);
    RayRecorder shot;
    {
        PointRecorder recorder([&](RecordedPoint& point) {
            if (story.points.size() < kMostPoints)
                story.points.push_back(explain_point(point, files));
        });
        story.color = raytrace::integrate_sample(pose.accel, pose.view, *pose.shading, film,
                                                 settings.integrator, pose.scratch, x, y, sample);
    }
    shot.tell(scene, pose, story);
    pose.shading->drop_frame(ignored);
    story.color = vec4(vec3(story.color) * float(settings.gain), story.color.w);
    return story;
}

const StoryVariable* find_variable(const PixelStory& story, std::string_view name, int line) {
    const StoryVariable* found = nullptr;
    for (const PointStory& point : story.points) {
        for (const StoryStep& step : point.steps)
            for (const StoryVariable& variable : step.changes)
                if (step.line == line && variable.name == name) found = &variable;
        if (found) break;
    }
    return found;
}

std::string_view ray_text(StoryRay::Kind kind) {
    constexpr std::string_view kNames[] = {"eye", "traced", "shadow"};
    return kNames[size_t(kind)];
}

std::string_view agreement_text(Agreement agreement) {
    switch (agreement) {
        case Agreement::Agrees:
            return "agrees";
        case Agreement::Differs:
            return "differs";
        case Agreement::Undecided:
            return "undecided";
        case Agreement::Unexplained:
            return "unexplained";
    }
    return "";
}

}  // namespace kinora
