// runtime/scene/ri/state/interpreter.cpp: which function does which request, and where each may
// stand.
#include "runtime/scene/ri/state/interpreter.h"
#include "rsl/link.h"

#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/calls/accepted_tokens.h"
#include "runtime/scene/ri/calls/ri.h"

namespace kinora::ri {
namespace {

Type type_of(rsl::BaseType base) {
    switch (base) {
        case rsl::BaseType::Color:
            return Type::Color;
        case rsl::BaseType::Point:
            return Type::Point;
        case rsl::BaseType::Vector:
            return Type::Vector;
        case rsl::BaseType::Normal:
            return Type::Normal;
        case rsl::BaseType::Matrix:
            return Type::Matrix;
        case rsl::BaseType::String:
            return Type::String;
        default:
            return Type::Float;
    }
}

bool is_shader_request(Request request) {
    switch (request) {
        case Request::Imager:
        case Request::LightSource:
        case Request::AreaLightSource:
        case Request::Surface:
        case Request::Atmosphere:
        case Request::Interior:
        case Request::Exterior:
        case Request::Displacement:
        case Request::Deformation:
        case Request::Shader:
        case Request::ShaderLayer:
            return true;
        default:
            return false;
    }
}

const rsl::ShaderParameter* formal_of(const rsl::Shader* shader, std::string_view name) {
    if (shader)
        for (const rsl::ShaderParameter& p : shader->parameters)
            if (p.name == name) return &p;
    return nullptr;
}

State first_state(std::string path, const ImportOptions& options) {
    State state;
    state.path = std::move(path);
    state.import = options;
    Attributes& attributes = state.attributes;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) attributes.u.matrix[c][r] = double(RiBezierBasis[r][c]);
    attributes.v = attributes.u;
    return state;
}

}  // namespace

Interpreter::Interpreter(std::string path, const ImportOptions& options, WorldChoice drawn,
                         InterpreterHost host, Diagnostics& diagnostics)
    : report_(diagnostics),
      state_(first_state(std::move(path), options)),
      drawn_(std::move(drawn)),
      host_(std::move(host)),
      shaders_(state_, report_, diagnostics),
      options_(state_, report_, shaders_),
      attributes_(state_, report_),
      transforms_(state_, report_),
      meshes_(drawn_.meshes ? drawn_.meshes : std::make_shared<MeshStore>()),
      branches_(state_, report_) {}

Interpreter::~Interpreter() = default;

void Interpreter::call(const Call& call) {
    if (branches_.leave_out(call)) return;
    if (!entered_.empty()) ++replayed_;
    const Call* outer = report_.begin(&call);
    if (!record(call)) dispatch(call);
    report_.begin(outer);
}

// Requests that nobody takes change nothing.
void Interpreter::dispatch(const Call& call) {
    using R = Request;
    using C = Interpreter;
    static const Handlers<C> kHandlers = {
        {R::FrameBegin, &C::begin_block},
        {R::AttributeBegin, &C::begin_block},
        {R::TransformBegin, &C::begin_block},
        {R::SolidBegin, &C::begin_block},
        {R::FrameEnd, &C::end_block},
        {R::AttributeEnd, &C::end_block},
        {R::TransformEnd, &C::end_block},
        {R::SolidEnd, &C::end_block},
        {R::ObjectEnd, &C::end_block},
        {R::ArchiveEnd, &C::end_block},
        {R::WorldBegin, &C::world_begin},
        {R::WorldEnd, &C::world_end},
        {R::ObjectBegin, &C::object_begin},
        {R::ObjectInstance, &C::object_instance},
        {R::MotionBegin, &C::motion_begin},
        {R::MotionEnd, &C::motion_end},
        {R::ArchiveBegin, &C::archive_begin},
        {R::ReadArchive, &C::read_archive},
        {R::Procedural, &C::procedural},
        {R::Polygon, &C::primitive},
        {R::GeneralPolygon, &C::primitive},
        {R::PointsPolygons, &C::primitive},
        {R::PointsGeneralPolygons, &C::primitive},
        {R::SubdivisionMesh, &C::primitive},
        {R::Patch, &C::primitive},
        {R::PatchMesh, &C::primitive},
        {R::NuPatch, &C::primitive},
        {R::Sphere, &C::primitive},
        {R::Cone, &C::primitive},
        {R::Cylinder, &C::primitive},
        {R::Hyperboloid, &C::primitive},
        {R::Paraboloid, &C::primitive},
        {R::Disk, &C::primitive},
        {R::Torus, &C::primitive},
        {R::Geometry, &C::geometry},
        {R::Points, &C::not_drawn},
        {R::Curves, &C::not_drawn},
        {R::Blobby, &C::not_drawn},
    };
    const RequestClass kind = row(call.request).kind;
    // Archives, which may hold worlds, are found along an option, conditions look at both, and
    // displays and the maps made of them tell what a picture needs.
    if (drawn_.counts_alone && kind != RequestClass::Block && kind != RequestClass::Anywhere &&
        kind != RequestClass::Map && call.request != Request::Option &&
        call.request != Request::Attribute && call.request != Request::Display)
        return;
    if (kind == RequestClass::Option && state_.in_world())
        return report_.add(Code::RI_OPTION_IN_WORLD, row(call.request).name);
    if (kind == RequestClass::Primitive && !state_.in_world())
        return report_.add(Code::RI_OUTSIDE_WORLD, row(call.request).name);
    if (!has_right_tokens(call)) return;
    kHandlers.call(*this, call) || branches_.call(call) || options_.call(call) ||
        attributes_.call(call) || shaders_.call(call) || transforms_.call(call);
}

// Tells each wrong word once. False: the call is left out for one.
bool Interpreter::has_right_tokens(const Call& call) {
    bool right = true;
    for (const WrongToken& wrong : wrong_tokens(call.request, call.arguments)) {
        right = right && !wrong.row->left_out;
        if (report_.is_new(fmt::format("{} {}", row(call.request).name, wrong.token)))
            report_.add(Code::RI_TOKEN_WRONG, row(call.request).name, wrong.token,
                        words_of(*wrong.row), wrong.row->otherwise);
    }
    return right;
}

bool Interpreter::transform_points(std::string_view from, std::string_view to,
                                   std::span<float> points) {
    return transforms_.transform_points(from, to, points);
}

// In an object or archive the shaders are those that are kept with it, else those of its place.
const rsl::ShaderParameter* Interpreter::formal_of_primitive(std::string_view name) {
    struct Row {
        Request request;
        const std::vector<Binding>* bound;
    };
    const Row rows[] = {{Request::Surface, &state_.attributes.surfaces},
                        {Request::Displacement, &state_.attributes.displacements}};
    const rsl::ShaderParameter* formal = nullptr;
    for (const Row& row : rows) {
        const std::vector<std::string>* kept = nullptr;
        for (const Recording& open : recording_)
            if (const auto& names = open.shaders.names(row.request)) kept = &*names;
        for (size_t k = 0; kept && k < kept->size() && !formal; ++k)
            formal = formal_of(shaders_.find((*kept)[k]).get(), name);
        for (size_t k = 0; !kept && k < row.bound->size() && !formal; ++k)
            formal = formal_of((*row.bound)[k]->shader.get(), name);
    }
    return formal;
}

std::optional<CountState> Interpreter::count_state() {
    if (!recording_.empty()) return std::nullopt;
    return CountState{
        int(state_.attributes.u.step), int(state_.attributes.v.step),
        state_.options.to_rgb.empty() ? 3 : uint32_t(state_.options.to_rgb.size() / 3)};
}

const Declaration* Interpreter::declared_by_shader(Request request, std::string_view shader,
                                                   std::string_view token) {
    const rsl::ShaderParameter* formal = nullptr;
    if (drawn_.counts_alone) return nullptr;
    if (is_shader_request(request)) {
        const std::shared_ptr<const rsl::Shader> found = shaders_.find(shader);
        formal = formal_of(found.get(), token);
        if (found && !formal && rsl::find_handle_parameter(*found, token)) {
            formal_ = {StorageClass::Uniform, Type::String, 0};
            return &formal_;
        }
    } else if (row(request).kind == RequestClass::Primitive) {
        formal = formal_of_primitive(token);
    }
    if (!formal) return nullptr;
    formal_.storage = StorageClass::Uniform;
    formal_.type = type_of(formal->type.base);
    formal_.array = formal->type.is_array() ? uint32_t(std::max(formal->type.array_length, 1)) : 0;
    if (row(request).kind == RequestClass::Primitive && formal->detail == rsl::Detail::Varying)
        formal_.storage = StorageClass::Varying;
    return &formal_;
}

}  // namespace kinora::ri
