// rsl/reference/inputs.cpp: first values of globals and parameters, by kernel inputs
// (rsl/model/kernel_keys.h).
#include <algorithm>

#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace {

// Globals with derivatives.
constexpr Global kSloped[] = {Global::P, Global::N, Global::I, Global::u,
                              Global::v, Global::s, Global::t};

template <class Real>
RefValue<Real> spread(BaseType type, Real x) {
    return {type, Dual<Real>(x), Dual<Real>(x), Dual<Real>(x)};
}

}  // namespace

template <class Real>
Real Reference<Real>::number(const KernelKey& key, Real otherwise) const {
    auto found = in.values.find(text(key));
    return found == in.values.end() ? otherwise : Real(found->second);
}

template <class Real>
auto Reference<Real>::input(const KernelKey& first, BaseType type, Slopes slopes) const -> Item {
    Item value(type);
    KernelKey key = first;
    auto slope = [&](Partial along) {
        KernelKey partial = partial_key(key, along);
        if (slopes == Slopes::None || partial.kind == KeyKind::None) return Real(0);
        return partial.kind == KeyKind::One ? Real(1) : number(partial, 0);
    };
    for (size_t k = 0; k < value.size(); ++k) {
        key.component = uint8_t(k);
        value.c[k] = {number(key, 0), slope(Partial::Du), slope(Partial::Dv)};
    }
    return value;
}

template <class Real>
auto Reference<Real>::first_value(Global id) -> Item {
    Item x = into_layer(kernel_value(id));
    if (!bends_normals() || x.type != BaseType::Normal) return x;
    Vec<Real> n = normalize(vec(x));
    return {x.type, n[0], n[1], n[2]};
}

// Du(p) ^ Dv(p), oriented as Ng; its slopes are those of N.
template <class Real>
Vec<Real> Reference<Real>::normal_of(const Vec<Real>& p) {
    Vec<Real> n = cross(along_u(p), along_v(p));
    Vec<Real> u = vec(first_value(Global::dPdu)), v = vec(first_value(Global::dPdv));
    Vec<Real> Ng = vec(global(Global::Ng)), N = vec(first_value(Global::N));
    if (decide(dot(rsl::cross(u, v), Ng).x < 0)) n = Number(-1) * n;
    for (size_t k = 0; k < 3; ++k) n[k].u = N[k].u, n[k].v = N[k].v;
    return n;
}

template <class Real>
auto Reference<Real>::kernel_value(Global id) -> Item {
    const GlobalInfo& info = global_info(id);
    BaseType type = info.type.base;
    if (id == Global::PI) return spread(type, Real(3.14159265358979323846));
    bool light_shader = layer->shader->kind == ShaderKind::Light;
    if (!((info.readers | info.writers) & in_kind(layer->shader->kind))) return Item(type);
    for (const ParamBinding& bound : layer->params)  // Cs, Os
        if (bound.name == info.name && bound.kind == ParamBinding::Kind::Layer)
            return left_by_layer(bound, type, 0);
        else if (bound.name == info.name)
            return input(parameter_key(uint32_t(layer_index), bound.name, -1, form_of(type), 0),
                         type);
    bool behind =
        layer->shader->kind == ShaderKind::Volume || layer->shader->kind == ShaderKind::Imager;
    if (id == Global::Ci || id == Global::Oi) {  // what a volume or imager is laid over
        if (behind) return input(global_key(id), type);
        return spread(type, Real(id == Global::Oi));
    }
    if (id == Global::alpha && layer->shader->kind == ShaderKind::Imager)
        return input(global_key(id), type);
    switch (id) {
        case Global::Cs:
        case Global::Os:
        case Global::alpha:
            return spread(type, Real(1));
        case Global::ncomps:
            return spread(type, Real(3));
        case Global::Ps:
            return light_shader ? input(global_key(Global::Ps), type) : kernel_value(Global::P);
        case Global::Ns:
            return light_shader ? input(global_key(Global::Ns), type) : kernel_value(Global::N);
        default:
            break;
    }
    if (light_shader && id == Global::N) return input(global_key(Global::Ns), type);
    if (light_shader && id == Global::P) {
        auto at = [&](int row) { return Number(number(space_key("shader", true, row, 3), 0)); };
        return {type, at(0), at(1), at(2)};
    }
    if (light_shader && id == Global::I) {
        Vec<Real> I = vec(global(Global::Ps)) - vec(global(Global::E));
        return {type, I[0], I[1], I[2]};
    }
    bool given = id == Global::E || id == Global::time || id == Global::dtime;
    if (light_shader && !given) return Item(type);
    bool sloped = std::find(std::begin(kSloped), std::end(kSloped), id) != std::end(kSloped);
    return input(global_key(id), type, sloped ? Slopes::Given : Slopes::None);
}

// `element` of an array parameter, or -1.
template <class Real>
auto Reference<Real>::parameter(const Symbol& symbol, int element) -> Item {
    BaseType type = symbol.type.base;
    const ParamBinding* bound = nullptr;
    for (const ParamBinding& b : layer->params)
        if (b.name == symbol.name) bound = &b;
    if (!bound || bound->kind == ParamBinding::Kind::Default) {
        if (element >= 0 || !symbol.initial) return Item(type);
        return convert(expr(*symbol.initial), type);
    }
    size_t first = size_t(std::max(element, 0));
    if (bound->kind == ParamBinding::Kind::Layer) return left_by_layer(*bound, type, first);
    Item value(type);
    if (bound->kind == ParamBinding::Kind::Constant) {
        if (type == BaseType::String && first < bound->strings.size())
            value.c[0] = Real(intern(bound->strings[first]));
        for (size_t k = 0; k < value.size() && type != BaseType::String; ++k)
            if (first * value.size() + k < bound->constant.size())
                value.c[k] = Real(bound->constant[first * value.size() + k]);
        return value;
    }
    KernelKey key = parameter_key(uint32_t(layer_index), symbol.name, element, form_of(type), 0);
    if (bound->kind == ParamBinding::Kind::Frame) return into_layer(input(key, type));
    Item varying = input(key, type, Slopes::Given);
    return bound->plain ? varying : from_object(varying);
}

// What a layer below left in a parameter; 0 where there is no such.
template <class Real>
auto Reference<Real>::left_by_layer(const ParamBinding& bound, BaseType type, size_t element)
    -> Item {
    if (bound.below > layer_index) return Item(type);
    const auto left = left_.parameters.find({layer_index - bound.below, bound.variable});
    if (left == left_.parameters.end() || element >= left->second.size()) return Item(type);
    return into_layer(convert(left->second[element], type));
}

template <class Real>
auto Reference<Real>::array_parameter(const Symbol& symbol) -> std::vector<Item> {
    std::vector<Item> items;
    for (int k = 0; k < symbol.type.array_length; ++k) items.push_back(parameter(symbol, k));
    auto* literal = as_if<ArrayLiteralExpr>(symbol.initial);
    bool bound = false;
    for (const ParamBinding& b : layer->params)
        bound = bound || (b.name == symbol.name && b.kind != ParamBinding::Kind::Default);
    if (!literal || bound) return items;
    for (size_t k = 0; k < literal->items.size() && k < items.size(); ++k)
        items[k] = convert(expr(*literal->items[k]), symbol.type.base);
    return items;
}

namespace {

// Where points, directions and normals stand among a service's arguments (results: -1 - index). By
// hand: lowering follows the letters of services.def, and the differential tests compare the two.
struct Triple {
    Service service;
    int at;
    BaseType type;
};
constexpr Triple kTriples[] = {
    {Service::shadow, 1, BaseType::Point},          {Service::shadow, 4, BaseType::Vector},
    {Service::shadow, 7, BaseType::Vector},         {Service::trace, 2, BaseType::Point},
    {Service::trace, 5, BaseType::Vector},          {Service::transmission, 2, BaseType::Point},
    {Service::transmission, 5, BaseType::Point},    {Service::occlusion, 2, BaseType::Point},
    {Service::occlusion, 5, BaseType::Normal},      {Service::occlusion, -2, BaseType::Vector},
    {Service::indirectdiffuse, 2, BaseType::Point}, {Service::indirectdiffuse, 5, BaseType::Normal},
    {Service::gather, 4, BaseType::Point},          {Service::gather, 7, BaseType::Vector},
    {Service::photons, 3, BaseType::Point},         {Service::photons, 6, BaseType::Normal},
};

}  // namespace

template <class Real>
std::vector<double> Reference<Real>::service(Service service, std::vector<double> args) {
    if (!in.service) return {};
    auto move = [&](std::vector<double>& numbers, bool results) {
        for (const Triple& t : kTriples) {
            size_t at = size_t(t.at < 0 ? -1 - t.at : t.at);
            if (t.service != service || (t.at < 0) != results || at + 3 > numbers.size()) continue;
            Item x(t.type);
            for (size_t k = 0; k < 3; ++k) x.c[k] = Number(Real(numbers[at + k]));
            x = results ? into_layer(x) : out_of_layer(x);
            for (size_t k = 0; k < 3; ++k) numbers[at + k] = double(x.c[k].x);
        }
    };
    if (bends_normals()) move(args, false);
    std::vector<double> answer = in.service(service, args);
    if (bends_normals()) move(answer, true);
    return answer;
}

// A parameter of the light of this turn of illuminance.
template <class Real>
std::vector<double> Reference<Real>::messages(std::string_view name, size_t count) const {
    if (!light) return {};
    if (count == 1 && name == "__nondiffuse") return {light->nondiffuse};
    if (count == 1 && name == "__nonspecular") return {light->nonspecular};
    for (auto& [known, numbers] : light->messages)
        if (known == name && numbers.size() == count) return numbers;
    return {};
}

#define KINORA_INPUT_METHODS(Real)                                                          \
    template Real Reference<Real>::number(const KernelKey&, Real) const;                    \
    template auto Reference<Real>::input(const KernelKey&, BaseType, Slopes) const->Item;   \
    template auto Reference<Real>::first_value(Global)->Item;                               \
    template auto Reference<Real>::kernel_value(Global)->Item;                              \
    template Vec<Real> Reference<Real>::normal_of(const Vec<Real>&);                        \
    template auto Reference<Real>::parameter(const Symbol&, int)->Item;                     \
    template auto Reference<Real>::array_parameter(const Symbol&)->std::vector<Item>;       \
    template std::vector<double> Reference<Real>::messages(std::string_view, size_t) const; \
    template std::vector<double> Reference<Real>::service(Service, std::vector<double>);
KINORA_INPUT_METHODS(float)
KINORA_INPUT_METHODS(double)

}  // namespace kinora::rsl
