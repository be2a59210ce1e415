// runtime/player/thumbnails.cpp: the scene that is shown, dressed in each shader.
#include "runtime/player/thumbnails.h"

#include <algorithm>
#include <new>
#include <utility>

#include "runtime/base/check.h"
#include "runtime/base/parallel.h"
#include "runtime/base/tasks/thread_priority.h"
#include "runtime/picture/frame/frame.h"
#include "runtime/player/session/places.h"
#include "runtime/scene/build/instances/dressed_scene.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

namespace {

constexpr int kWidth = 96, kHeight = 72;
constexpr int kSamples = 4;

bool is_for_importers(std::string_view name) {
    constexpr std::string_view kTheirs[] = {"collada_", "gltf_", "default_"};
    return std::ranges::any_of(kTheirs, [&](std::string_view p) { return name.starts_with(p); });
}

// Looked at as the picture does, and as near as the object's box allows.
FreeCamera camera_for(const Scene& scene, const Pose& pose, const ViewOrder& view,
                      const std::string& node) {
    auto [low, high] = box_of(scene, scene, pose, find_node(scene, node));
    if (!(low.x <= high.x)) low = scene.low, high = scene.high;
    FreeCamera camera = view.camera ? *view.camera : free_camera_of(pose.view, scene.origin, 1);
    frame_box(camera, low, high, double(kWidth) / kHeight);
    return camera;
}

}  // namespace

bool ThumbnailOrder::same(const ThumbnailOrder& o) const {
    return scene == o.scene && material == o.material && node == o.node;
}

std::vector<std::string> shaders_to_choose() {
    std::vector<std::string> names;
    for (std::string_view name : library_shader_names()) {
        if (is_for_importers(name)) continue;
        auto shader = library_shader(name);
        if (shader && shader->kind == rsl::ShaderKind::Surface) names.emplace_back(name);
    }
    return names;
}

SceneEdits edits_with_text(SceneEdits edits, const SceneEdits::Text& text) {
    auto of_material = [&](const auto& row) { return row.first == text.material; };
    auto of_param = [&](const auto& row) { return row.first.starts_with(text.material + "."); };
    std::erase_if(edits.shaders, of_material);
    std::erase_if(edits.params, of_param);
    std::erase_if(edits.texts, [&](const auto& row) { return row.material == text.material; });
    edits.texts.push_back(text);
    return edits;
}

Thumbnails::Thumbnails(std::function<void()> wake)
    : wake_(std::move(wake)), thread_([this] { run(); }) {}

Thumbnails::~Thumbnails() {
    {
        std::lock_guard lock(mutex_);
        quit_ = true;
        stop_ = 1;
    }
    wanted_.notify_one();
    thread_.join();
}

void Thumbnails::order(const ThumbnailOrder& order) {
    {
        std::lock_guard lock(mutex_);
        if (known_ && known_->same(order)) return;
        known_ = order_ = order;
        known_->shown.reset();  // a scene is kept for its pictures alone
        stop_ = 1;
    }
    wanted_.notify_one();
}

void Thumbnails::forget() {
    std::lock_guard lock(mutex_);
    order_.reset();
    known_.reset();
    made_.clear();
    stop_ = 1;
}

std::vector<std::shared_ptr<const Thumbnail>> Thumbnails::made() const {
    std::lock_guard lock(mutex_);
    return made_;
}

bool Thumbnails::idle() const {
    std::lock_guard lock(mutex_);
    return !order_ && !working_;
}

void Thumbnails::run() {
    SerialScope serial;  // the frames of the scene shown go first
    lower_thread_priority();
    std::unique_lock lock(mutex_);
    while (true) {
        wanted_.wait(lock, [&] { return quit_ || order_; });
        if (quit_) return;
        ThumbnailOrder order = *std::exchange(order_, std::nullopt);
        stop_ = 0;
        working_ = true;
        made_.clear();
        lock.unlock();
        try {
            make(order);
        } catch (const std::bad_alloc&) {  // there are as many as there is memory for
        } catch (const CheckFailed&) {     // the picture's thread tells of it
        }
        lock.lock();
        working_ = false;
        lock.unlock();
        wake_();
        lock.lock();
    }
}

void Thumbnails::make(const ThumbnailOrder& order) {
    for (const std::string& shader : shaders_to_choose()) {
        if (stop_) return;
        auto made = std::make_shared<Thumbnail>();
        if (!make(order, shader, *made)) continue;
        {
            std::lock_guard lock(mutex_);
            if (stop_) return;
            made_.push_back(std::move(made));
        }
        wake_();
    }
}

// False: there is no picture of it.
bool Thumbnails::make(const ThumbnailOrder& order, const std::string& shader, Thumbnail& to) const {
    const ShownScene& shown = *order.shown;
    const auto& materials = shown.scene->description->materials;
    const auto material = std::ranges::find(materials, order.material, &MaterialDefinition::id);
    if (material == materials.end()) return false;
    Diagnostics ignored;  // what is shown reports them
    const Dress dress{uint32_t(material - materials.begin()), library_shader(shader),
                      find_node(*shown.scene, order.node)};
    const std::unique_ptr<Scene> scene = dressed_scene(*shown.scene, dress, ignored);
    if (!scene) return false;
    Pose pose(*scene);
    ViewOrder view = order.view;
    view.width = kWidth;
    view.height = kHeight;
    view.only_light = kNone;
    PlacedCamera placed;
    FrameStats stats;
    FrameSettings settings = refined_settings(shown, *scene, pose, view, placed);
    if (!pose_frame(*scene, pose, time_of(shown, view), settings, stats, ignored)) return false;
    view.camera = camera_for(*scene, pose, view, order.node);
    view.follow.reset();
    settings = refined_settings(shown, *scene, pose, view, placed);
    settings.integrator.samples_per_pixel = kSamples;
    settings.stop = &stop_;
    raytrace::Film film;
    if (!render_frame(*scene, pose, time_of(shown, view), settings, film, stats, ignored))
        return false;
    to.shader = shader;
    to.width = film.width;
    to.height = film.height;
    to.rgba = to_8_bit(film, shown.encoding).rgba;
    return true;
}

}  // namespace kinora
