// runtime/scene/ri/state/interpreter.cpp: which function does which request, and where each may
// stand.
#include "runtime/scene/ri/state/interpreter.h"

#include "runtime/scene/description/findings.h"

namespace kinora::ri {
namespace {

rsl::CompileOptions compile_options(const ImportOptions& import) {
    rsl::CompileOptions options;
    options.include_directories = import.include_directories;
    return options;
}

std::string folder_of(const std::string& path) {
    return path.substr(0, path.rfind('/') + 1);
}

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

}  // namespace

Interpreter::Interpreter(std::string path, const ImportOptions& options, InterpreterHost host,
                         Diagnostics& diagnostics)
    : path_(std::move(path)),
      import_(options),
      host_(std::move(host)),
      diagnostics_(diagnostics),
      shaders_(compile_options(options), folder_of(path_), diagnostics) {
    constexpr double kBezier[4][4] = {{-1, 3, -3, 1}, {3, -6, 3, 0}, {-3, 3, 0, 0}, {1, 0, 0, 0}};
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) attributes_.u.matrix[c][r] = kBezier[r][c];
    attributes_.v = attributes_.u;
}

Interpreter::~Interpreter() = default;

const std::vector<Interpreter::Handler>& Interpreter::handlers() {
    static const std::vector<Handler> table = [] {
        std::vector<Handler> made(requests().size(), &Interpreter::ignore);
        auto set = [&](std::initializer_list<Request> requests, Handler handler) {
            for (Request request : requests) made[size_t(request)] = handler;
        };
        using R = Request;
        using I = Interpreter;
        set({R::FrameBegin, R::AttributeBegin, R::TransformBegin, R::SolidBegin}, &I::begin_block);
        set({R::FrameEnd, R::AttributeEnd, R::TransformEnd, R::SolidEnd, R::ObjectEnd,
             R::ArchiveEnd},
            &I::end_block);
        set({R::WorldBegin}, &I::world_begin);
        set({R::WorldEnd}, &I::world_end);
        set({R::ObjectBegin}, &I::object_begin);
        set({R::ObjectInstance}, &I::object_instance);
        set({R::MotionBegin}, &I::motion_begin);
        set({R::MotionEnd}, &I::motion_end);
        set({R::ArchiveBegin}, &I::archive_begin);
        set({R::ReadArchive}, &I::read_archive);
        set({R::Procedural}, &I::procedural);
        set({R::IfBegin}, &I::if_begin);
        set({R::ElseIf, R::Else}, &I::branch_else);
        set({R::IfEnd}, &I::if_end);
        set({R::Format}, &I::format);
        set({R::FrameAspectRatio}, &I::frame_aspect_ratio);
        set({R::ScreenWindow}, &I::screen_window);
        set({R::CropWindow}, &I::crop_window);
        set({R::Projection}, &I::projection);
        set({R::Clipping}, &I::clipping);
        set({R::ClippingPlane}, &I::clipping_plane);
        set({R::DepthOfField}, &I::depth_of_field);
        set({R::Shutter}, &I::shutter);
        set({R::PixelSamples}, &I::pixel_samples);
        set({R::PixelFilter}, &I::pixel_filter);
        set({R::Exposure}, &I::exposure);
        set({R::Imager}, &I::imager);
        set({R::Quantize}, &I::quantize);
        set({R::Display}, &I::display);
        set({R::ColorSamples}, &I::color_samples);
        set({R::RelativeDetail}, &I::relative_detail);
        set({R::Option}, &I::option);
        set({R::Color}, &I::color);
        set({R::Opacity}, &I::opacity);
        set({R::TextureCoordinates}, &I::texture_coordinates);
        set({R::ShadingRate}, &I::shading_rate);
        set({R::Matte}, &I::matte);
        set({R::Attribute}, &I::attribute);
        set({R::Detail}, &I::detail);
        set({R::DetailRange}, &I::detail_range);
        set({R::Orientation}, &I::orientation);
        set({R::ReverseOrientation}, &I::reverse_orientation);
        set({R::Sides}, &I::sides);
        set({R::Basis}, &I::basis);
        set({R::TrimCurve}, &I::trim_curve);
        set({R::LightSource}, &I::light_source);
        set({R::AreaLightSource}, &I::area_light_source);
        set({R::Illuminate}, &I::illuminate);
        set({R::Surface, R::Displacement, R::Deformation, R::Atmosphere, R::Interior, R::Exterior},
            &I::surface);
        set({R::ShaderLayer}, &I::shader_layer);
        set({R::ConnectShaderLayers, R::Shader}, &I::co_shader);
        set({R::MakeTexture, R::MakeBump, R::MakeLatLongEnvironment}, &I::make_map);
        set({R::MakeCubeFaceEnvironment}, &I::make_cube_map);
        set({R::MakeShadow}, &I::make_shadow);
        set({R::Identity}, &I::identity);
        set({R::Transform}, &I::transform);
        set({R::ConcatTransform}, &I::concat_transform);
        set({R::Perspective}, &I::perspective);
        set({R::Translate}, &I::translate);
        set({R::Rotate}, &I::rotate);
        set({R::Scale}, &I::scale);
        set({R::Skew}, &I::skew);
        set({R::CoordinateSystem}, &I::coordinate_system);
        set({R::ScopedCoordinateSystem}, &I::scoped_coordinate_system);
        set({R::CoordSysTransform}, &I::coord_sys_transform);
        set({R::Polygon, R::GeneralPolygon, R::PointsPolygons, R::PointsGeneralPolygons,
             R::SubdivisionMesh, R::Patch, R::PatchMesh, R::NuPatch, R::Sphere, R::Cone,
             R::Cylinder, R::Hyperboloid, R::Paraboloid, R::Disk, R::Torus},
            &I::primitive);
        set({R::Geometry}, &I::geometry);
        set({R::Points, R::Curves, R::Blobby}, &I::not_drawn);
        return made;
    }();
    return table;
}

void Interpreter::call(const Call& call) {
    if (skipped_branch_) {
        if (call.request == Request::IfBegin) ++skipped_branch_;
        if (call.request != Request::IfEnd || --skipped_branch_) return;
    }
    const Call* outer = std::exchange(now_, &call);
    if (!record(call)) dispatch(call);
    now_ = outer;
}

void Interpreter::dispatch(const Call& call) {
    const RequestClass kind = row(call.request).kind;
    // Archives, which may hold worlds, are found along an option.
    if (lists_alone() && kind != RequestClass::Block && kind != RequestClass::Anywhere &&
        call.request != Request::Option)
        return;
    if (kind == RequestClass::Option && in_world())
        return report(Code::RI_OPTION_IN_WORLD, row(call.request).name);
    if (kind == RequestClass::Primitive && !in_world())
        return report(Code::RI_OUTSIDE_WORLD, row(call.request).name);
    (this->*handlers()[size_t(call.request)])(call);
}

void Interpreter::not_done(const char* what, std::string_view why) {
    if (told_.insert(fmt::format("{} {}", what, why)).second) report(Code::RI_NOT_DONE, what, why);
}

const Declaration* Interpreter::declared_by_shader(Request request, std::string_view shader,
                                                   std::string_view token) {
    const rsl::ShaderParameter* formal = nullptr;
    if (lists_alone()) return nullptr;
    if (is_shader_request(request)) {
        formal = formal_of(find_shader(shader).get(), token);
    } else if (row(request).kind == RequestClass::Primitive) {
        for (const auto* layers : {&attributes_.surfaces, &attributes_.displacements})
            for (const Binding& binding : *layers)
                if (!formal) formal = formal_of(binding->shader.get(), token);
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
