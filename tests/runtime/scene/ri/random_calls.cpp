// tests/runtime/scene/ri/random_calls.cpp: arguments by the letters of requests.def, and of
// primitives, whose arrays must fit, by hand.
#include "tests/runtime/scene/ri/random_calls.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <deque>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace kinora::ri {
namespace {

constexpr const char* kNames[] = {"a", "b[2]", "c d", "Kd", "Cs", "P", "st", "[", "uniform", "x:y"};
constexpr const char* kTypes[] = {"float",  "integer", "string", "color",    "point",   "vector",
                                  "normal", "hpoint",  "matrix", "float[2]", "color[3]"};
constexpr const char* kClasses[] = {"constant ", "uniform ",     "varying ",
                                    "vertex ",   "facevarying ", ""};

}  // namespace

struct RandomCallMaker {
    explicit RandomCallMaker(uint32_t seed) : random(seed) {}

    int below(int count) { return int(random() % uint32_t(count)); }
    template <class T, size_t n>
    const T& one_of(const T (&values)[n]) {
        return values[below(int(n))];
    }
    RtPointer known(const std::vector<RtPointer>& handles) {
        return handles.empty() ? nullptr : handles[size_t(below(int(handles.size())))];
    }
    RtFilterFunc filter() { return below(2) ? RiSincFilter : RiGaussianFilter; }
    int integer();
    float real();
    char* text();
    std::span<const int> integers(size_t count, int least, int most);
    std::span<const float> reals(size_t count);
    std::span<const char* const> texts(size_t count);
    Values argument(char letter, size_t color_samples);
    std::vector<Values> by_letters(Request request, const CountState& state);
    std::vector<Values> faces(bool loops);
    std::vector<Values> subdivision();
    std::vector<Values> patch_mesh(const CountState& state);
    std::vector<Values> nurbs();
    std::vector<Values> trim();
    char* token();
    void* values_of(const Declaration& declaration, size_t count);
    void declare();
    void send(Context& context, Request request, const std::vector<Values>& arguments);

    std::minstd_rand random;
    std::vector<RtPointer> lights, objects;
    // What calls point at, until the next one.
    std::deque<std::vector<int>> kept_integers;
    std::deque<std::vector<float>> kept_reals;
    std::deque<std::vector<const char*>> kept_texts;
    std::deque<std::string> strings;
};

int RandomCallMaker::integer() {
    constexpr int kEdges[] = {0,
                              1,
                              -1,
                              255,
                              -256,
                              32767,
                              65536,
                              std::numeric_limits<int>::min(),
                              std::numeric_limits<int>::max()};
    return below(4) ? below(1000) - 500 : one_of(kEdges);
}

// Not NaN, which is a finding.
float RandomCallMaker::real() {
    constexpr float kEdges[] = {0, -0.0f, 1, 1e-45f, 3.4028235e38f, 16777216, 0.1f, -1e30f};
    if (below(3) == 0) return one_of(kEdges);
    float any = std::bit_cast<float>(uint32_t(random()) << 1 ^ uint32_t(random()));
    return any - any == 0 ? any : 1.5f;
}

// Of any bytes.
char* RandomCallMaker::text() {
    std::string& made = strings.emplace_back();
    for (int n = below(3) ? below(6) : below(300); n > 0; --n)
        made += below(3) ? char('a' + below(26)) : char(1 + below(255));
    return made.data();
}

std::span<const int> RandomCallMaker::integers(size_t count, int least, int most) {
    std::vector<int>& made = kept_integers.emplace_back(count);
    for (int& value : made) value = least + below(most - least + 1);
    return made;
}

std::span<const float> RandomCallMaker::reals(size_t count) {
    std::vector<float>& made = kept_reals.emplace_back(count);
    for (float& value : made) value = real();
    return made;
}

std::span<const char* const> RandomCallMaker::texts(size_t count) {
    std::vector<const char*>& made = kept_texts.emplace_back(count);
    for (const char*& value : made) value = text();
    return made;
}

void RandomCallMaker::declare() {
    constexpr const char* kScopes[] = {"", "", "Surface:wood:", "Sphere::", "Option:limits:"};
    strings.push_back(std::string(one_of(kScopes)) + one_of(kNames));
    char* name = strings.back().data();
    strings.push_back(std::string(one_of(kClasses)) + one_of(kTypes));
    RiDeclare(name, strings.back().data());
}

Values RandomCallMaker::argument(char letter, size_t color_samples) {
    constexpr const RtBasis* kBases[] = {&RiBezierBasis, &RiBSplineBasis, &RiCatmullRomBasis,
                                         &RiHermiteBasis, &RiPowerBasis};
    const std::pair<char, std::function<Values()>> kLetters[] = {
        {'i', [&] { return Values(integer()); }},
        {'f', [&] { return Values(real()); }},
        {'s', [&] { return Values(text()); }},
        {'m', [&] { return Values(reals(16)); }},
        {'b', [&] { return Values(reals(6)); }},
        {'c', [&] { return Values(reals(color_samples)); }},
        {'x',
         [&] {
             if (below(2)) return Values(reals(16));
             return Values(std::span<const float>(&(*one_of(kBases))[0][0], 16));
         }},
        {'I', [&] { return Values(integers(size_t(below(5)), -1000, 100000)); }},
        {'F', [&] { return Values(reals(size_t(below(5)))); }},
        {'S', [&] { return Values(texts(size_t(below(5)))); }},
    };
    for (const auto& [known, make] : kLetters)
        if (known == letter) return make();
    return {};
}

// Numbers of corners and, with `loops`, of loops of polygons, and their indices.
std::vector<Values> RandomCallMaker::faces(bool loops) {
    std::vector<Values> made;
    std::span<const int> sizes = integers(size_t(below(4)), 0, 3);
    if (loops) {
        made.push_back(sizes);
        sizes = integers(size_t(std::accumulate(sizes.begin(), sizes.end(), 0)), 0, 5);
    }
    made.push_back(sizes);
    made.push_back(integers(size_t(std::accumulate(sizes.begin(), sizes.end(), 0)), 0, 6));
    return made;
}

std::vector<Values> RandomCallMaker::subdivision() {
    std::vector<Values> made = faces(false);
    made.insert(made.begin(), Values(text()));
    size_t tags = size_t(below(3)), whole = 0, fractions = 0;
    std::span<const int> counts = integers(2 * tags, 0, 3);
    for (size_t i = 0; i < counts.size(); ++i) (i % 2 ? fractions : whole) += size_t(counts[i]);
    made.push_back(texts(tags));
    made.push_back(counts);
    made.push_back(integers(whole, -5, 5));
    made.push_back(reals(fractions));
    return made;
}

std::vector<Values> RandomCallMaker::patch_mesh(const CountState& state) {
    const bool bicubic = below(2);
    auto points = [&](bool periodic, int step) {
        if (!bicubic) return 2 + below(4);
        return periodic ? (1 + below(3)) * std::max(step, 1) : 4 + below(3) * std::max(step, 1);
    };
    auto wrap = [](bool periodic) { return periodic ? "periodic" : "nonperiodic"; };
    const bool u = below(2), v = below(2);
    return {bicubic ? "bicubic" : "bilinear", points(u, state.ustep), wrap(u),
            points(v, state.vstep), wrap(v)};
}

std::vector<Values> RandomCallMaker::nurbs() {
    std::vector<Values> made;
    for (int direction = 0; direction < 2; ++direction) {
        int points = 1 + below(5), order = 1 + below(5);
        for (const Values& value :
             {Values(points), Values(order), Values(reals(size_t(points + order))), Values(real()),
              Values(real())})
            made.push_back(value);
    }
    return made;
}

std::vector<Values> RandomCallMaker::trim() {
    std::span<const int> loops = integers(size_t(below(3)), 0, 2);
    size_t curves = size_t(std::accumulate(loops.begin(), loops.end(), 0));
    std::span<const int> orders = integers(curves, 1, 4), counts = integers(curves, 0, 4);
    size_t points = size_t(std::accumulate(counts.begin(), counts.end(), 0));
    size_t knots = points + size_t(std::accumulate(orders.begin(), orders.end(), 0));
    return {loops,  orders,        reals(knots),  reals(curves), reals(curves),
            counts, reals(points), reals(points), reals(points)};
}

std::vector<Values> RandomCallMaker::by_letters(Request request, const CountState& state) {
    std::vector<Values> made;
    for (char letter : row(request).arguments)
        if (letter != '*' && letter != '?') made.push_back(argument(letter, state.color_samples));
    return made;
}

char* RandomCallMaker::token() {
    constexpr const char* kPlain[] = {"a", "b", "x", "Cs2"};
    if (below(2)) return strings.emplace_back(one_of(kNames)).data();
    return strings
        .emplace_back(fmt::format("{}{} {}", one_of(kClasses), one_of(kTypes), one_of(kPlain)))
        .data();
}

void* RandomCallMaker::values_of(const Declaration& declaration, size_t count) {
    count = std::max<size_t>(count, 1);  // no null pointer, which ends a list
    if (declaration.type == Type::Integer)
        return const_cast<int*>(integers(count, -99999, 99999).data());
    if (declaration.type == Type::String) return const_cast<char**>(texts(count).data());
    return const_cast<float*>(reals(count).data());
}

void RandomCallMaker::send(Context& context, Request request,
                           const std::vector<Values>& arguments) {
    const CountState& state = context.count_state();
    const uint32_t vertices = uint32_t(below(5));
    std::vector<char*> tokens;
    std::vector<void*> values;
    CountedCall counted = count_values(request, arguments, state, vertices);
    std::string_view shader = arguments.empty() ? "" : arguments[0].string();
    auto add = [&](char* token) {
        std::string_view name;
        auto declaration = context.resolve(request, shader, token, name);
        const bool place = name == "P" || name == "Pw" || name == "Pz";
        if (!declaration || (place && !tokens.empty())) return;
        tokens.push_back(token);
        values.push_back(
            values_of(*declaration, size_t(counted.counts.of(declaration->storage)) *
                                        declaration->elements() *
                                        components(declaration->type, state.color_samples)));
    };
    const bool has_parameters = row(request).has_parameters();
    if (has_parameters && row(request).kind == RequestClass::Primitive)
        add(strings.emplace_back("vertex point P").data());
    for (int n = has_parameters ? below(4) : 0; n > 0; --n) add(token());
    context.send(request, arguments, int(tokens.size()), tokens.data(), values.data(), vertices);
}

namespace {

using Maker = RandomCallMaker;

// Requests whose arguments must fit each other.
struct ArgumentsRow {
    Request request;
    std::vector<Values> (*make)(Maker& m, const CountState& state);
};
constexpr ArgumentsRow kArguments[] = {
    {Request::ColorSamples,
     [](Maker& m, const CountState&) {
         const size_t numbers = size_t(3 + 3 * m.below(5));
         return std::vector<Values>{m.reals(numbers), m.reals(numbers)};
     }},
    {Request::GeneralPolygon,
     [](Maker& m, const CountState&) {
         return std::vector<Values>{m.integers(size_t(m.below(4)), 0, 4)};
     }},
    {Request::PointsPolygons, [](Maker& m, const CountState&) { return m.faces(false); }},
    {Request::PointsGeneralPolygons, [](Maker& m, const CountState&) { return m.faces(true); }},
    {Request::SubdivisionMesh, [](Maker& m, const CountState&) { return m.subdivision(); }},
    {Request::Patch,
     [](Maker& m, const CountState&) {
         return std::vector<Values>{m.below(2) ? "bicubic" : "bilinear"};
     }},
    {Request::PatchMesh, [](Maker& m, const CountState& state) { return m.patch_mesh(state); }},
    {Request::NuPatch, [](Maker& m, const CountState&) { return m.nurbs(); }},
    {Request::TrimCurve, [](Maker& m, const CountState&) { return m.trim(); }},
    {Request::Curves,
     [](Maker& m, const CountState&) {
         return std::vector<Values>{m.below(2) ? "cubic" : "linear",
                                    m.integers(size_t(m.below(3)), 0, 7),
                                    m.below(2) ? "periodic" : "nonperiodic"};
     }},
    {Request::Basis,
     [](Maker& m, const CountState&) {
         return std::vector<Values>{m.argument('x', 3), 1 + m.below(5), m.argument('x', 3),
                                    1 + m.below(5)};
     }},
    {Request::Blobby,
     [](Maker& m, const CountState&) {
         return std::vector<Values>{m.below(3), m.integers(size_t(m.below(5)), 0, 1003),
                                    m.reals(size_t(m.below(5))), m.texts(size_t(m.below(3)))};
     }},
    {Request::Procedural,
     [](Maker& m, const CountState&) {
         return std::vector<Values>{"RunProgram", m.texts(2), m.reals(6)};
     }},
};

// Requests that C functions make in a way of their own; ArchiveRecord is none of RIB.
struct CallRow {
    Request request;
    void (*call)(Maker& m);
};
constexpr CallRow kCalls[] = {
    {Request::Declare, [](Maker& m) { m.declare(); }},
    {Request::ObjectBegin, [](Maker& m) { m.objects.push_back(RiObjectBegin()); }},
    {Request::ObjectInstance,
     [](Maker& m) {
         if (RtPointer object = m.known(m.objects)) RiObjectInstance(object);
     }},
    {Request::LightSource, [](Maker& m) { m.lights.push_back(RiLightSource(m.text(), RI_NULL)); }},
    {Request::AreaLightSource,
     [](Maker& m) { m.lights.push_back(RiAreaLightSource(m.text(), RI_NULL)); }},
    {Request::Illuminate,
     [](Maker& m) {
         if (RtPointer light = m.known(m.lights)) RiIlluminate(light, RtBoolean(m.below(2)));
     }},
    {Request::Matte, [](Maker& m) { RiMatte(RtBoolean(m.below(2))); }},
    {Request::ArchiveBegin, [](Maker& m) { RiArchiveBegin(m.text(), RI_NULL); }},
    {Request::ArchiveRecord, [](Maker&) {}},
    {Request::ErrorHandler,
     [](Maker& m) { RiErrorHandler(m.below(2) ? RiErrorIgnore : RiErrorPrint); }},
    {Request::PixelFilter, [](Maker& m) { RiPixelFilter(m.filter(), m.real(), m.real()); }},
    {Request::MakeTexture,
     [](Maker& m) {
         RiMakeTexture(m.text(), m.text(), m.text(), m.text(), m.filter(), m.real(), m.real(),
                       RI_NULL);
     }},
    {Request::MakeBump,
     [](Maker& m) {
         RiMakeBump(m.text(), m.text(), m.text(), m.text(), m.filter(), m.real(), m.real(),
                    RI_NULL);
     }},
    {Request::MakeLatLongEnvironment,
     [](Maker& m) {
         RiMakeLatLongEnvironment(m.text(), m.text(), m.filter(), m.real(), m.real(), RI_NULL);
     }},
    {Request::MakeCubeFaceEnvironment,
     [](Maker& m) {
         RiMakeCubeFaceEnvironment(m.text(), m.text(), m.text(), m.text(), m.text(), m.text(),
                                   m.text(), m.real(), m.filter(), m.real(), m.real(), RI_NULL);
     }},
};

}  // namespace

RandomCalls::RandomCalls(uint32_t seed) : maker_(std::make_unique<Maker>(seed)) {}
RandomCalls::~RandomCalls() = default;

void RandomCalls::call(Context& context) {
    Maker& m = *maker_;
    m.kept_integers.clear(), m.kept_reals.clear(), m.kept_texts.clear(), m.strings.clear();
    const Request request = Request(m.below(int(requests().size())));
    auto own = std::ranges::find(kCalls, request, &CallRow::request);
    if (own != std::end(kCalls)) return own->call(m);
    const CountState& state = context.count_state();
    auto fitting = std::ranges::find(kArguments, request, &ArgumentsRow::request);
    m.send(
        context, request,
        fitting == std::end(kArguments) ? m.by_letters(request, state) : fitting->make(m, state));
}

}  // namespace kinora::ri
