// runtime/scene/dae/import.cpp: COLLADA's nodes, cameras and numbers as a SceneDescription.
#include "runtime/scene/dae/import.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "collada/document/open_scene.h"
#include "collada/extract/extract.h"
#include "runtime/base/numbers.h"
#include "runtime/scene/dae/import_p.h"
#include "runtime/scene/description/display_color.h"

namespace kinora {

// Bytes that are no archive are those of `file.document`; else that is a file.
static std::optional<collada::Document> read_opened(const collada::SceneFile& file,
                                                    const SceneSource& source,
                                                    Diagnostics& diagnostics) {
    if (source.bytes && file.folder.empty())
        return collada::read_document_text(file.document, std::string(*source.bytes), diagnostics);
    return collada::read_document(file.document, diagnostics);
}

static std::optional<collada::SceneFile> open_source(const SceneSource& source,
                                                     Diagnostics& diagnostics) {
    if (!source.bytes) return collada::open_scene(source.path, diagnostics);
    if (!collada::is_archive_bytes(*source.bytes))
        return collada::SceneFile{source.path, {}, {}, {}, {}};
    return collada::open_scene_bytes(source.path, *source.bytes, diagnostics);
}

std::optional<SceneDescription> import_collada(const SceneSource& source,
                                               const ImportOptions& options,
                                               Diagnostics& diagnostics) {
    std::optional<collada::SceneFile> file = open_source(source, diagnostics);
    if (!file) return std::nullopt;
    std::optional<collada::Document> document = read_opened(*file, source, diagnostics);
    if (!document) return std::nullopt;
    collada::ExtractOptions extract_options;
    extract_options.folder = file->folder;
    extract_options.scene_id = file->scene_id;
    extract_options.models = file->models;
    extract_options.allow_external = options.allow_external;
    extract_options.confine = options.confine;
    extract_options.meter = options.meter;
    if (options.up_axis) extract_options.up_axis = collada::UpAxis(*options.up_axis);
    std::optional<collada::SceneData> data =
        collada::extract(*document, diagnostics, extract_options);
    if (!data) return std::nullopt;
    bool archive = !file->folder.empty();
    std::string folder = document->directory();
    document.reset();  // the scene's data stand alone
    SceneDescription description;
    description.path = source.path;
    auto files = std::make_shared<std::vector<std::shared_ptr<const void>>>(data->files);
    files->push_back(file->keep);
    description.files = std::move(files);
    limit_files(description, folder, options);
    // An archive's files are in it. It is not written to: its folder is ours and dies with the
    // scene.
    if (archive) {
        description.readable.add(file->folder);
        description.pictures = description.readable;
        description.writable = AllowedPaths(options.allow_external);
    }
    // Images that the document holds were unpacked into folders of ours.
    for (const collada::Image& image : data->images)
        if (!image.path.empty() && !description.pictures.contains(image.path))
            description.pictures.add(image.path.substr(0, image.path.rfind('/') + 1));
    ColladaImport(*data, options, diagnostics, description).run();
    return description;
}

static EnvironmentDefinition environment_of(const collada::SceneData& data,
                                            const collada::Environment& from) {
    EnvironmentDefinition to;
    if (from.image != collada::kNone) {
        // Of one that is not there, the name: it is looked for once more, and then told.
        const collada::Image& image = data.images[from.image];
        for (const std::string* name : {&image.path, &image.uri, &image.id})
            if (to.picture.empty()) to.picture = *name;
    }
    to.color = dvec3(from.color[0], from.color[1], from.color[2]);
    to.brightness = from.brightness;
    to.rotation = from.rotation;
    to.behind_picture = !from.hidden;
    to.where = from.where;
    return to;
}

void ColladaImport::run() {
    out_.meter = data_.asset.meter;
    out_.up_axis = UpAxis(data_.asset.up_axis);
    out_.camera_node = data_.camera_node;
    out_.start_time = data_.start_time;
    out_.end_time = data_.end_time;
    out_.frame_rate = data_.frame_rate;
    allocate_values();
    import_meshes();
    import_skins();
    import_morphs();
    import_materials();
    import_lights();
    import_cameras();
    out_.picture = picture_shaders(data_.rsl_materials);
    if (data_.environment) out_.environment = environment_of(data_, *data_.environment);
    import_nodes();
    add_linear_vertex_colors();
    import_animation();
    settle_colors();
    import_clips();
}

uint32_t ColladaImport::append(const double* numbers, size_t count) {
    uint32_t offset = uint32_t(out_.values.size());
    out_.values.insert(out_.values.end(), numbers, numbers + count);
    return offset;
}

// COLLADA writes matrices for column vectors, RSL for row vectors.
uint32_t ColladaImport::append(const collada::ParamValue& value) {
    std::vector<double> numbers = value.numbers;
    for (size_t m = 0; value.type == collada::ParamType::Float4x4 && m + 16 <= numbers.size();
         m += 16)
        for (size_t r = 0; r < 4; ++r)
            for (size_t c = 0; c < 4; ++c) numbers[m + c * 4 + r] = value.numbers[m + r * 4 + c];
    return append(numbers.data(), numbers.size());
}

// Where a display colour stands in linear light. Another count is no colour and stays as it is.
ValueSlot ColladaImport::linear(ValueSlot display) {
    if (!options_.decode_colors || display.count != 3) return display;
    auto [known, is_new] = linear_colors_.try_emplace(display.offset, 0);
    if (is_new) {
        const double* v = &out_.values[display.offset];
        dvec3 color = linear_of_display({v[0], v[1], v[2]});
        known->second = append(&color.x, 3);
    }
    return {known->second, 3};
}

// Colours that nothing moves are decoded for good; the others in every frame.
void ColladaImport::settle_colors() {
    for (const auto& [display, linear] : linear_colors_) {
        auto moves = out_.animated.begin() + display;
        if (std::find(moves, moves + 3, true) == moves + 3) continue;
        std::fill_n(out_.animated.begin() + linear, 3, true);
        out_.moving_colors.push_back({display, linear});
    }
    std::sort(out_.moving_colors.begin(), out_.moving_colors.end(),
              [](const MovingColor& a, const MovingColor& b) { return a.display < b.display; });
}

void ColladaImport::allocate_values() {
    auto append_slots = [this](const auto& slots, std::vector<uint32_t>& offsets) {
        for (const collada::Slot& s : slots)
            offsets.push_back(append(s.values.data(), std::max<size_t>(s.count, 4)));
    };
    for (const collada::Node& node : data_.nodes) {
        auto& offsets = transform_values_.emplace_back();
        for (const collada::Transform& transform : node.transforms) {
            std::array<double, 16> numbers = transform.slot.values;
            if (transform.kind == collada::TransformKind::Matrix)  // kept in document order
                for (int column = 0; column < 4; ++column)
                    for (int row = 0; row < 4; ++row)
                        numbers[size_t(row * 4 + column)] =
                            transform.slot.values[size_t(column * 4 + row)];
            offsets.push_back(append(numbers.data(), numbers.size()));
        }
    }
    for (const collada::Light& light : data_.lights)
        append_slots(light.slots, light_values_.emplace_back());
    for (const collada::Camera& camera : data_.cameras)
        append_slots(camera.slots, camera_values_.emplace_back());
    for (const collada::Effect& effect : data_.effects) {
        auto& params = param_values_.emplace_back();
        for (const collada::Param& param : effect.params) params.push_back(append(param.value));
        auto& common = common_values_.emplace_back();
        if (!effect.common) continue;
        for (const collada::CommonValue& value : effect.common->slots)
            common.push_back(append(value.slot.values.data(), 4));
    }
    for (const collada::Material& material : data_.materials) {
        auto& setparams = setparam_values_.emplace_back();
        auto& of_param = setparam_of_.emplace_back();  // the first of several wins
        for (const collada::SetParam& set : material.setparams) {
            of_param.try_emplace(set.param, uint32_t(setparams.size()));
            setparams.push_back(append(set.value));
        }
    }
    for (const collada::Morph& morph : data_.morphs)
        morph_values_.push_back(append(morph.weights.data(), morph.weights.size()));
}

ValueSlot ColladaImport::slot(const collada::TargetRef& ref) const {
    auto whole = [&](const std::vector<std::vector<uint32_t>>& offsets) {
        return ValueSlot{offsets[ref.owner][ref.slot] + ref.first, ref.count};
    };
    switch (ref.kind) {
        case collada::Owner::None:
            return {};
        case collada::Owner::Transform:
            return whole(transform_values_);
        case collada::Owner::Light:
            return whole(light_values_);
        case collada::Owner::Camera:
            return whole(camera_values_);
        case collada::Owner::EffectParam:
            return whole(param_values_);
        case collada::Owner::EffectCommon:
            return whole(common_values_);
        case collada::Owner::MaterialParam:
            return whole(setparam_values_);
        case collada::Owner::MorphWeight:
            return {morph_values_[ref.owner] + ref.first, ref.count};
    }
    return {};
}

// Bits: node definitions, then morphs, then one for all looks (their frame blocks are made anew
// each frame anyway).
uint32_t ColladaImport::owner_bit(const collada::TargetRef& ref) const {
    uint32_t nodes = uint32_t(out_.nodes.size());
    uint32_t morphs = uint32_t(data_.morphs.size());
    if (ref.kind == collada::Owner::Transform) return ref.owner;
    if (ref.kind == collada::Owner::MorphWeight) return nodes + ref.owner;
    return nodes + morphs;
}

dmat4 ColladaImport::conversion(uint32_t index) const {
    return index == collada::kNone ? dmat4(1.0) : data_.conversions[index];
}

MeshUse ColladaImport::mesh_use(const collada::MeshInstance& instance) {
    MeshUse use;
    use.mesh = instance.geometry;
    use.morph = instance.morph;
    use.skin = instance.skin;
    use.joint_nodes = instance.joint_nodes;
    use.lights = instance.lights;
    use.conversion = conversion(instance.conversion);
    for (const collada::MaterialBinding& binding : instance.materials) {
        MaterialUse& material = use.materials.emplace_back();
        material.symbol = binding.symbol;
        material.material = binding.material;
        for (const collada::VertexInputBinding& input : binding.vertex_inputs)
            material.vertex_bindings.push_back(
                {input.semantic, input.input_semantic, input.input_set});
        for (const collada::ParamBinding& param : binding.params)
            material.params.emplace_back(param.semantic, bound_slot(binding.material, param));
    }
    return use;
}

// All numbers, or a text.
static UserAttribute user_attribute(const std::string& name, const std::string& text) {
    UserAttribute attribute{name, {}, text};
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const std::optional<double> number = number_of<double>(word);
        if (!number) return {name, {}, text};
        attribute.numbers.push_back(*number);
    }
    return attribute;
}

void ColladaImport::import_nodes() {
    for (size_t n = 0; n < data_.nodes.size(); ++n) {
        const collada::Node& from = data_.nodes[n];
        NodeDefinition& to = out_.nodes.emplace_back();
        to.id = from.id;
        to.sid = from.sid;
        to.name = from.name;
        to.where = from.where;
        to.invisible = from.hidden;
        for (const auto& [name, text] : from.attributes)
            to.attributes.push_back(user_attribute(name, text));
        for (size_t t = 0; t < from.transforms.size(); ++t)
            to.transforms.push_back(
                {TransformKind(from.transforms[t].kind), transform_values_[n][t]});
        for (uint32_t child : from.children)
            to.children.push_back({child, conversion(data_.nodes[child].conversion)});
        for (const collada::NodeInstance& instance : from.instances)
            to.children.push_back({instance.node, conversion(instance.conversion)});
        for (const collada::MeshInstance& mesh : from.meshes) to.meshes.push_back(mesh_use(mesh));
        for (const collada::LightInstance& light : from.lights)
            if (light.conversion == collada::kNone) to.lights.push_back(light.light);
        for (const collada::CameraInstance& camera : from.cameras)
            if (camera.conversion == collada::kNone) to.cameras.push_back(camera.camera);
    }
    for (size_t n = 0; n < data_.nodes.size(); ++n) {
        for (const collada::LightInstance& light : data_.nodes[n].lights)
            if (light.conversion != collada::kNone)
                add_reference(n, light.conversion).lights.push_back(light.light);
        for (const collada::CameraInstance& camera : data_.nodes[n].cameras)
            if (camera.conversion != collada::kNone)
                add_reference(n, camera.conversion).cameras.push_back(camera.camera);
    }
    for (uint32_t root : data_.roots)
        out_.roots.push_back({root, conversion(data_.nodes[root].conversion)});
}

// A node below the n-th for a light or camera in other units or axes: theirs is the matrix.
NodeDefinition& ColladaImport::add_reference(size_t n, uint32_t conversion_index) {
    out_.nodes[n].children.push_back({uint32_t(out_.nodes.size()), conversion(conversion_index)});
    NodeDefinition& node = out_.nodes.emplace_back();
    node.reference = true;
    return node;
}

void ColladaImport::import_cameras() {
    using collada::CameraSlot;
    for (size_t c = 0; c < data_.cameras.size(); ++c) {
        const collada::Camera& from = data_.cameras[c];
        auto slot_of = [&](CameraSlot s) {
            return from[s].present() ? ValueSlot{camera_values_[c][size_t(s)], 1} : ValueSlot{};
        };
        CameraDefinition& to = out_.cameras.emplace_back();
        to.id = from.id;
        to.name = from.name;
        to.where = from.where;
        to.orthographic = from.orthographic;
        to.x = slot_of(from.orthographic ? CameraSlot::Xmag : CameraSlot::Xfov);
        to.y = slot_of(from.orthographic ? CameraSlot::Ymag : CameraSlot::Yfov);
        to.aspect = slot_of(CameraSlot::AspectRatio);
        to.znear = slot_of(CameraSlot::Znear);
        to.zfar = slot_of(CameraSlot::Zfar);
        to.clips = to.znear.present() || to.zfar.present();
        to.picture = picture_shaders(from.rsl_materials);
    }
}

// Its own animations move in a clip, and those that belong to none.
void ColladaImport::import_clips() {
    std::vector<bool> named(data_.channels.size(), false);
    for (const collada::Clip& clip : data_.clips)
        for (uint32_t channel : clip.channels) named[channel] = true;
    for (const collada::Clip& clip : data_.clips) {
        ClipDefinition& to = out_.clips.emplace_back();
        to.id = clip.id;
        to.name = clip.name.empty() ? clip.id : clip.name;
        to.start = clip.start;
        to.end = clip.end;
        std::vector<bool> plays = named;
        plays.flip();
        for (uint32_t channel : clip.channels) plays[channel] = true;
        if (std::find(plays.begin(), plays.end(), false) != plays.end())
            to.animation = std::make_shared<anim::Animation>(animation_of(plays));
    }
}

}  // namespace kinora
