// runtime/play/thumbnails.cpp: the scene read once, then built and rendered for each shader.
#include "runtime/play/thumbnails.h"

#include <algorithm>
#include <new>
#include <utility>

#include "runtime/base/parallel.h"
#include "runtime/description/shader_library.h"
#include "runtime/frame/frame.h"
#include "runtime/images/image_io.h"
#include "runtime/play/session/session.h"

namespace kinora {

namespace {

constexpr int kWidth = 96, kHeight = 72;
constexpr int kSamples = 4;

bool is_for_importers(std::string_view name) {
    constexpr std::string_view kTheirs[] = {"collada_", "gltf_", "default_"};
    return std::ranges::any_of(kTheirs, [&](std::string_view p) { return name.starts_with(p); });
}

// No more than the object, its lights and few samples.
SceneRequest small_request_of(const ThumbnailOrder& order) {
    SceneRequest small = order.request;
    small.width = kWidth;
    small.height = kHeight;
    small.auto_exposure = false;
    small.quality.samples_per_pixel = kSamples;
    small.findings = {};
    const std::string id = order.node.substr(order.node.rfind('/') + 1);
    if (!id.empty()) small.only = {id};
    return small;
}

// Looked at as the picture does, and as near as the object's box allows.
FreeCamera camera_for(const ShownScene& shown, Pose& pose, const ViewOrder& view,
                      const std::string& node) {
    const Scene& scene = *shown.scene;
    auto [low, high] = box_of(scene, pose, find_node(scene, node));
    if (!(low.x <= high.x)) low = scene.low, high = scene.high;
    FreeCamera camera;
    if (view.camera)
        camera = *view.camera;
    else if (std::optional<raytrace::Camera> seen =
                 view_of(scene, pose, view, time_of(shown, view)))
        camera = free_camera_of(*seen, scene.origin, 1);
    frame_box(camera, low, high, double(kWidth) / kHeight);
    return camera;
}

}  // namespace

bool ThumbnailOrder::same(const ThumbnailOrder& o) const {
    return request.scene == o.request.scene && material == o.material && node == o.node;
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
        }
        lock.lock();
        working_ = false;
        lock.unlock();
        wake_();
        lock.lock();
    }
}

void Thumbnails::make(const ThumbnailOrder& order) {
    const SceneRequest small = small_request_of(order);
    Diagnostics read;
    std::optional<ImportedScene> imported = import_requested(small, read);
    if (!imported) return;
    for (const std::string& name : shaders_to_choose()) {
        if (stop_) return;
        ShownScene shown;
        shown.request = small;
        shown.rate = imported->rate;
        Diagnostics diagnostics;
        diagnostics.files = read.files.fork();
        ImportedScene dressed = *imported;
        const SceneEdits edits = edits_with_text(
            order.edits, {order.material, name + ".sl", std::string(library_shader_text(name))});
        if (!apply_edits(dressed, edits, small, diagnostics)) continue;
        BuiltScene built = build_imported(std::move(dressed), diagnostics);
        if (!built.scene) continue;
        shown.scene = std::move(built.scene);
        const Scene& scene = *shown.scene;
        Pose& pose = *built.pose;
        shown.settings = frame_settings(small, scene, pose, diagnostics, &stop_);
        ViewOrder view = order.view;
        view.width = kWidth;
        view.height = kHeight;
        view.only_light = kNone;
        const double time = time_of(shown, view);
        FrameStats stats;
        if (!pose_frame(scene, pose, time, shown.settings, stats, diagnostics)) continue;
        view.camera = camera_for(shown, pose, view, order.node);
        view.follow.reset();
        PlacedCamera placed;
        FrameSettings settings = refined_settings(shown, scene, pose, view, placed);
        settings.stop = &stop_;
        raytrace::Film film;
        if (!render_frame(scene, pose, time, settings, film, stats, diagnostics)) continue;
        auto made = std::make_shared<Thumbnail>();
        made->shader = name;
        made->width = film.width;
        made->height = film.height;
        made->rgba = to_8_bit(film, small.color).rgba;
        {
            std::lock_guard lock(mutex_);
            if (stop_) return;
            made_.push_back(std::move(made));
        }
        wake_();
    }
}

}  // namespace kinora
