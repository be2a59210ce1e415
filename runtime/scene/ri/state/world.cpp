// runtime/scene/ri/state/world.cpp: a scene description, primitive by primitive.
#include "runtime/scene/ri/state/world.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

#include "runtime/scene/description/shader_library.h"

namespace kinora::ri {
namespace {

// Camera space of the interface looks along z, that of cameras along -z.
dmat4 turned_z(dmat4 m) {
    for (int c = 0; c < 4; ++c) m[c][2] = -m[c][2];
    return m;
}

std::array<double, 16> numbers_of(const dmat4& m) {
    std::array<double, 16> numbers;
    std::memcpy(numbers.data(), &m[0][0], sizeof numbers);
    return numbers;
}

// The shapes of a picture: 3.2, section 4.1.1. The part that the crop window leaves.
struct Frame {
    int width, height;
    double aspect;
};
Frame frame_of(const Options& options) {
    Frame frame{options.width, options.height, 1};
    double aspect = options.width * options.pixel_aspect / options.height;
    frame.aspect = options.frame_aspect.value_or(aspect);
    if (frame.aspect > aspect * (1 + 1e-9))
        frame.height = int(std::lround(options.width * options.pixel_aspect / frame.aspect));
    else if (frame.aspect < aspect * (1 - 1e-9))
        frame.width = int(std::lround(options.height * frame.aspect / options.pixel_aspect));
    frame.width = std::max(frame.width, 1);
    frame.height = std::max(frame.height, 1);
    return frame;
}

// A transformation as one that moves alone, and sizes behind it along x, y and z: a camera has no
// size, but its window and its planes do.
struct Parts {
    dvec3 size{1.0};
    dmat4 placed;
};
Parts parts_of(const dmat4& m) {
    Parts made{dvec3(1.0), m};
    for (int r = 0; r < 3; ++r) made.size[r] = glm::length(dvec3(m[0][r], m[1][r], m[2][r]));
    if (!(made.size.x * made.size.y * made.size.z > 0)) return {dvec3(1.0), m};
    if (glm::determinant(dmat3(m)) < 0) made.size.x = -made.size.x;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) made.placed[c][r] /= made.size[r];
    return made;
}

std::array<double, 4> screen_of(const Options& options, double aspect) {
    if (options.screen_window) return *options.screen_window;
    if (aspect >= 1) return {-aspect, aspect, -1, 1};
    return {-1, 1, -1 / aspect, 1 / aspect};
}

struct Pixels {
    int first, last;
};
// What a file has are floats: 0.1 of 640 pixels, a little more than 64, are 64.
Pixels cropped(int size, double low, double high) {
    constexpr double kFloatError = 1e-7;
    auto at = [&](double x) {
        return int(std::clamp(std::ceil(x - kFloatError * size), 0.0, double(size - 1)));
    };
    Pixels made{at(size * low), at(size * high - 1)};
    made.last = std::max(made.first, made.last);
    return made;
}

// What Quantize said of it. Variables that it did not name are as colours.
std::optional<Quantization> quantization_of(const FileDisplay& display, const Options& options) {
    const DisplayContent content = content_of(display);
    const bool alone = content.depth && !content.is_picture();
    for (const std::string& what : {alone ? "z" : content.variable, std::string("rgba")})
        if (auto said = options.quantizations.find(what); said != options.quantizations.end())
            return said->second;
    return {};
}

FilePicture picture_of(const Options& options) {
    FilePicture made;
    if (options.samples)
        made.samples = std::max(1, int(std::lround((*options.samples)[0] * (*options.samples)[1])));
    made.filter = options.filter;
    made.filter_width = options.filter_width;
    made.filter_height = options.filter_height;
    made.filter_values = options.filter_values;
    made.pixel_aspect = options.pixel_aspect;
    made.exposure = options.exposure;
    made.displays = options.displays;
    for (FileDisplay& display : made.displays)
        if (!display.quantization) display.quantization = quantization_of(display, options);
    return made;
}

// What differs between materials, as bits.
class MaterialKey {
  public:
    void add(const ShaderBinding& binding, const dmat4& to_camera) {
        add(reinterpret_cast<uint64_t>(&binding));
        add(binding.to_camera != to_camera);
    }
    void add(uint64_t bits) { bits_.push_back(bits); }
    void add(const dvec3& numbers) {
        for (int k = 0; k < 3; ++k) add(std::bit_cast<uint64_t>(numbers[k]));
    }
    std::vector<uint64_t> take() { return std::move(bits_); }

  private:
    std::vector<uint64_t> bits_;
};

constexpr size_t kLastingTriangles = 1000;  // trees of less are not worth a place of their own

uint32_t bits_of(const Visibility& v) {
    return uint32_t(v.camera | v.reflections << 1 | v.diffuse << 2 | v.shadows << 3 | v.matte << 4);
}

// How much larger than the file's own the picture is.
double enlargement(const FilePicture& own, const ImportOptions& import) {
    const double x = double(import.width) / own.width, y = double(import.height) / own.height;
    const double size = std::max(x, y);
    return import.scale * (size > 0 ? size : 1);
}

}  // namespace

WorldCamera camera_of(const Options& options) {
    WorldCamera made{picture_of(options), {}, 0};
    Frame frame = frame_of(options);
    std::array<double, 4> screen = screen_of(options, frame.aspect);
    const Projection& projection = options.projection;
    double unit = projection.perspective ? std::tan(radians(projection.fov) / 2) : 1;
    Pixels x = cropped(frame.width, options.crop[0], options.crop[1]);
    Pixels y = cropped(frame.height, options.crop[2], options.crop[3]);
    double dx = (screen[1] - screen[0]) / frame.width, dy = (screen[3] - screen[2]) / frame.height;
    made.window[0] = unit * (screen[0] + dx * x.first);
    made.window[1] = unit * (screen[0] + dx * (x.last + 1));
    made.window[2] = unit * (screen[3] - dy * (y.last + 1));
    made.window[3] = unit * (screen[3] - dy * y.first);
    made.pixels = 1 / (unit * std::min(std::abs(dx), std::abs(dy)));
    FilePicture& picture = made.picture;
    picture.full_width = frame.width, picture.full_height = frame.height;
    picture.left = x.first, picture.top = y.first;
    picture.width = x.last - x.first + 1, picture.height = y.last - y.first + 1;
    return made;
}

World::World(const Options& options, const std::string& path, const ImportOptions& import,
             const dmat4& camera_from_world, int number, bool in_film)
    : options_(options),
      camera_from_world_(camera_from_world),
      camera_(camera_of(options)),
      enlarged_(enlargement(camera_.picture, import)),
      curve_error_(import.curve_error),
      in_film_(in_film) {
    out_.path = path;
    out_.up_axis = UpAxis::Y;
    out_.textures_from_top = true;
    limit_files(out_, path.substr(0, path.rfind('/') + 1), import);
    out_.world_space = turned_z(camera_from_world);
    camera_.picture.number = number;
    out_.start_time = out_.end_time = options.shutter_open;
    add_camera();
}

void World::add_camera() {
    CameraDefinition camera;
    camera.id = "camera";
    camera.orthographic = !options_.projection.perspective;
    auto [size, placed] = parts_of(options_.projection.from_camera);
    const double* w = camera_.window;
    const double depth = camera.orthographic ? 1 : size.z;
    const double x = depth / size.x, y = depth / size.y;
    camera.window = {w[0] * x, w[1] * x, w[2] * y, w[3] * y};
    camera.clips = true;
    double near = std::max(options_.near / size.z, 1e-10),
           far = std::min(options_.far / size.z, 1e30);
    camera.znear = values(std::span(&near, 1));
    camera.zfar = values(std::span(&far, 1));
    for (const dvec4& plane : options_.planes)
        camera.planes.emplace_back(plane.x, plane.y, -plane.z, plane.w);
    for (const Binding& imager : options_.imagers)
        camera.picture.imagers.push_back(shader_use(*imager, nullptr));
    out_.cameras.push_back(std::move(camera));
    // What the transformation was at Projection comes between the camera and the screen.
    NodeDefinition& node = out_.nodes[this->node(glm::inverse(placed), "camera node")];
    node.cameras = {0};
    // A camera node looks along its own -z.
    for (int r = 0; r < 3; ++r) out_.values[node.transforms[0].value + size_t(4 * r + 2)] *= -1;
}

ValueSlot World::values(std::span<const double> numbers) {
    ValueSlot slot{uint32_t(out_.values.size()), uint32_t(numbers.size())};
    out_.values.insert(out_.values.end(), numbers.begin(), numbers.end());
    return slot;
}

// A node that stands there; those without an id are one for each place.
uint32_t World::node(const dmat4& to_camera, std::string id) {
    const bool named = !id.empty();
    if (!named)
        if (auto known = nodes_.find(numbers_of(to_camera)); known != nodes_.end())
            return known->second;
    dmat4 m = turned_z(to_camera);
    double rows[16];
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) rows[4 * r + c] = m[c][r];
    NodeDefinition made;
    made.id = std::move(id);
    made.transforms = {{TransformKind::Matrix, values(rows).offset}};
    uint32_t index = uint32_t(out_.nodes.size());
    out_.nodes.push_back(std::move(made));
    out_.roots.push_back({index, dmat4(1.0)});
    if (!named) nodes_.emplace(numbers_of(to_camera), index);
    return index;
}

std::string World::space_name(const dmat4& to_camera) {
    auto [entry, is_new] = spaces_.try_emplace(numbers_of(to_camera));
    if (is_new) {
        entry->second = "shader space " + std::to_string(spaces_.size());
        node(to_camera, entry->second);
    }
    return entry->second;
}

ShaderUse World::shader_use(const ShaderBinding& binding, const dmat4* object_to_camera) {
    ShaderUse use;
    use.shader = binding.shader;
    use.untinted = false;
    use.links = binding.links;
    for (const ShaderArgument& argument : binding.arguments) {
        ParamSource source;
        source.name = argument.name;
        source.strings = argument.strings;
        if (!argument.numbers.empty()) source.value = values(argument.numbers);
        source.where = binding.where;
        use.params.push_back(std::move(source));
    }
    if (object_to_camera && *object_to_camera != binding.to_camera)
        use.space = space_name(binding.to_camera);
    return use;
}

std::vector<ShaderUse> World::shader_uses(const std::vector<Binding>& bindings,
                                          const dmat4& to_camera) {
    std::vector<ShaderUse> uses;
    for (const Binding& binding : bindings) uses.push_back(shader_use(*binding, &to_camera));
    return uses;
}

// "wood", "wood 2": the next picture of a film has the same names for the same shaders.
std::string World::numbered(const ShaderUse& use) {
    const std::string name = use.shader ? std::string(use.shader->name) : "no shader";
    const int count = ++worn_[name];
    return count == 1 ? name : fmt::format("{} {}", name, count);
}

uint32_t World::light(const Light& light) {
    auto [entry, is_new] = lights_.try_emplace(light.get(), uint32_t(out_.lights.size()));
    if (!is_new) return entry->second;
    held_.push_back(light);
    LightDefinition definition;
    definition.shader = shader_use(light->shader, nullptr);
    definition.id = numbered(definition.shader);
    definition.shadows = light->shadows;
    definition.samples = uint32_t(std::max(light->samples, 0));
    definition.where = light->shader.where;
    out_.lights.push_back(std::move(definition));
    if (light->area) return entry->second;  // it stands in materials; this is what lists name
    // A light's space is its node's with z turned round.
    uint32_t at = node(light->shader.to_camera, fmt::format("light node {}", entry->second));
    for (int r = 0; r < 3; ++r)
        out_.values[out_.nodes[at].transforms[0].value + size_t(4 * r + 2)] *= -1;
    out_.nodes[at].lights = {entry->second};
    return entry->second;
}

// In SceneDescription::atmospheres; kNone: there are no shaders.
uint32_t World::atmosphere(const std::vector<Binding>& bindings) {
    if (bindings.empty()) return kNone;
    auto [entry, is_new] = atmospheres_.try_emplace(bindings, uint32_t(out_.atmospheres.size()));
    if (!is_new) return entry->second;
    std::vector<ShaderUse>& uses = out_.atmospheres.emplace_back();
    for (const Binding& binding : bindings) {
        uses.push_back(shader_use(*binding, nullptr));
        uses.back().space = space_name(binding->to_camera);
    }
    return entry->second;
}

std::vector<uint32_t> World::light_list(const Attributes& attributes) {
    std::vector<uint32_t> list;
    for (const Light& on : attributes.lights) list.push_back(light(on));
    std::ranges::sort(list);
    auto repeated = std::ranges::unique(list);
    list.erase(repeated.begin(), repeated.end());
    return list;
}

// `any_color`: the meshes that wear it have their own.
uint32_t World::material(const Attributes& attributes, const dmat4& to_camera, bool any_color) {
    const std::vector<Binding>* all[] = {&attributes.surfaces,     &attributes.displacements,
                                         &attributes.deformations, &attributes.interiors,
                                         &attributes.exteriors,    &attributes.atmospheres};
    MaterialKey key;
    for (const auto* bindings : all) {
        for (const Binding& binding : *bindings) key.add(*binding, to_camera);
        key.add(bindings->size());
    }
    if (const LightBinding* light = attributes.area_light.get()) key.add(light->shader, to_camera);
    if (!any_color) key.add(attributes.color);
    key.add(attributes.opacity);
    key.add(any_color | attributes.two_sided << 1 | attributes.no_surface << 2);
    auto [entry, is_new] = materials_.try_emplace(key.take(), uint32_t(out_.materials.size()));
    if (!is_new) return entry->second;
    for (const auto* bindings : all) held_.insert(held_.end(), bindings->begin(), bindings->end());
    MaterialDefinition made;
    made.name = attributes.name;
    made.surfaces = shader_uses(attributes.surfaces, to_camera);
    if (made.surfaces.empty()) {
        ShaderUse plain;
        plain.shader = library_shader(attributes.no_surface ? "null" : "defaultsurface");
        made.surfaces.push_back(std::move(plain));
    }
    made.id = numbered(made.surfaces.back());
    made.displacements = shader_uses(attributes.displacements, to_camera);
    made.transformations = shader_uses(attributes.deformations, to_camera);
    made.interior = shader_uses(attributes.interiors, to_camera);
    made.exterior = shader_uses(attributes.exteriors, to_camera);
    made.hide_backfaces = !attributes.two_sided;
    ParamSource color, opacity;
    color.name = "Cs", opacity.name = "Os";
    color.value = values(std::span(&attributes.color.x, 3));
    opacity.value = values(std::span(&attributes.opacity.x, 3));
    for (auto* uses : {&made.surfaces, &made.displacements})
        for (ShaderUse& use : *uses) {
            use.params.push_back(color);
            use.params.push_back(opacity);
        }
    if (attributes.area_light) {
        held_.push_back(attributes.area_light);
        made.lights = {shader_use(attributes.area_light->shader, &to_camera)};
        made.light_shadows = attributes.area_light->shadows;
        made.light_samples = uint32_t(std::max(attributes.area_light->samples, 0));
        made.light = light(attributes.area_light);
    }
    made.atmosphere = atmosphere(attributes.atmospheres);
    out_.materials.push_back(std::move(made));
    return entry->second;
}

void World::use_mesh(uint32_t mesh, uint32_t material, const Attributes& attributes,
                     const dmat4& to_camera) {
    MeshUse use;
    use.mesh = mesh;
    MaterialUse worn;
    worn.material = material;
    use.materials = {worn};
    use.lights = light_list(attributes);
    use.visibility = attributes.visibility;
    out_.nodes[node(to_camera)].meshes.push_back(std::move(use));
}

uint32_t World::push_mesh(MeshDefinition mesh, const Attributes& attributes) {
    const uint32_t index = uint32_t(out_.meshes.size());
    mesh.id = fmt::format("primitive {}", index);
    mesh.name = attributes.name;
    for (const PrimitiveGroup& group : mesh.groups) triangles_ += group.triangles.size() / 3;
    out_.meshes.push_back(std::move(mesh));
    return index;
}

bool World::names_object_space(const Binding& binding) {
    auto [known, is_new] = in_object_space_.try_emplace(binding.get(), false);
    if (!is_new) return known->second;
    held_.push_back(binding);
    auto names = [](std::string_view text) { return text == "object"; };
    for (const ShaderArgument& argument : binding->arguments)
        known->second |= std::ranges::any_of(argument.strings, names);
    if (!binding->shader) return known->second;
    for (const rsl::Token& token : binding->shader->ast->tokens.tokens)
        known->second |= token.text == "\"object\"";
    for (const rsl::LinkedPart& part : binding->shader->parts)
        known->second |= part.text && part.text->find("\"object\"") != std::string::npos;
    return known->second;
}

// Whether the primitive looks the same as a part of a mesh in the file's world.
bool World::merges(const MeshDefinition& mesh, const Attributes& attributes,
                   const Placement& placement) {
    if (!MergedMeshes::takes(mesh) || attributes.area_light || !attributes.displacements.empty() ||
        !attributes.deformations.empty() || !attributes.interiors.empty() ||
        !attributes.exteriors.empty())
        return false;
    const double determinant = glm::determinant(dmat3(placement.to_world));
    if (determinant == 0 || !std::isfinite(1 / determinant)) return false;
    auto is_plain = [&](const Binding& b) { return !names_object_space(b); };
    return std::ranges::all_of(attributes.surfaces, is_plain) &&
           std::ranges::all_of(attributes.atmospheres, is_plain);
}

void World::merge(const MeshDefinition& mesh, const Attributes& attributes,
                  const Placement& placement) {
    const MergedMeshes::Look look{material(attributes, camera_from_world_, true),
                                  light_list(attributes), bits_of(attributes.visibility),
                                  attributes.name};
    const uint32_t begun =
        merged_.add(out_.meshes, mesh, look, placement.to_world, attributes.color);
    triangles_ += mesh.groups[0].triangles.size() / 3;
    if (begun == kNone) return;
    out_.meshes[begun].id = fmt::format("primitives {}", begun);
    out_.meshes[begun].name = attributes.name;
    use_mesh(begun, look.material, attributes, camera_from_world_);
}

void World::draw(KnownMesh& known, const Attributes& attributes, const Placement& placement) {
    if (known.small && merges(*known.small, attributes, placement))
        return merge(*known.small, attributes, placement);
    if (known.mesh == kNone && known.small) known.mesh = push_mesh(*known.small, attributes);
    if (known.mesh == kNone) return;
    use_mesh(known.mesh, material(attributes, placement.to_camera, false), attributes,
             placement.to_camera);
}

void World::add(MeshDefinition mesh, const Attributes& attributes, const Placement& placement) {
    KnownMesh known;
    if (merges(mesh, attributes, placement))
        known.small = std::move(mesh);
    else
        known.mesh = push_mesh(std::move(mesh), attributes);
    draw(known, attributes, placement);
}

void World::add(const MeshKey& key, const Attributes& attributes, const Placement& placement,
                MakeMesh make) {
    auto [known, is_new] = known_.try_emplace(key);
    if (is_new)
        if (std::optional<MeshDefinition> mesh = make()) {
            if (MergedMeshes::takes(*mesh))
                known->second.small = std::move(mesh);
            else
                known->second.mesh = push_mesh(std::move(*mesh), attributes);
        }
    draw(known->second, attributes, placement);
}

PictureScale World::scale(const dmat4& to_camera) const {
    PictureScale made;
    made.to_camera = options_.projection.from_camera * to_camera;
    made.orthographic = !options_.projection.perspective;
    made.pixels = camera_.pixels * enlarged_;
    made.near = std::max(options_.near, 1e-3);
    return made;
}

TessellationLimits World::limits() const {
    constexpr size_t kMostTriangles = 16'000'000, kLeast = 2000;
    TessellationLimits made;
    made.error = curve_error_;
    const size_t left = kMostTriangles - std::min(kMostTriangles, triangles_);
    made.triangles = std::clamp(left / 8, kLeast, made.triangles);
    return made;
}

// Where every mesh sees every light, nothing is to be said.
void World::settle_lights() {
    std::vector<uint32_t> all(out_.lights.size());
    std::iota(all.begin(), all.end(), 0u);
    for (NodeDefinition& node : out_.nodes)
        for (MeshUse& use : node.meshes)
            if (use.lights == all) use.lights.reset();
}

SceneDescription World::take(const std::map<std::string, dmat4, std::less<>>& spaces) {
    for (const auto& [name, to_camera] : spaces) node(to_camera, name);
    settle_lights();
    for (MeshDefinition& mesh : out_.meshes)
        mesh.lasts = in_film_ && mesh.groups[0].triangles.size() >= 3 * kLastingTriangles;
    out_.animated.assign(out_.values.size(), false);
    out_.file_picture = std::move(camera_.picture);
    return std::move(out_);
}

}  // namespace kinora::ri
