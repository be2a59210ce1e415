// runtime/scene/ri/bytestream/call_request.cpp: a request as a call of its C function. The type of
// the function says which argument goes where; counts, which RIB does not write, and handles are
// put in by hand.
#include "runtime/scene/ri/bytestream/call_request_p.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <tuple>

namespace kinora::ri {
namespace {

// Arguments of a C function, one after another.
class Cursor {
  public:
    explicit Cursor(RequestReader& read) : read_(read) {}

    template <class T>
    T take();

  private:
    const Values& next() { return read_.arguments()[at_++]; }

    RequestReader& read_;
    size_t at_ = 0;
};

template <class T>
T* changeable(std::span<const T> values) {
    return const_cast<T*>(values.data());
}
char** changeable(std::span<const char* const> values) {
    return const_cast<char**>(values.data());
}

template <>
RtFloat Cursor::take() {
    return next().real();
}
// Behind the arguments stands the number of parameters.
template <>
RtInt Cursor::take() {
    return at_ < read_.arguments().size() ? next().integer() : read_.count();
}
template <>
RtBoolean Cursor::take() {
    return next().integer() != 0;
}
template <>
char* Cursor::take() {
    return const_cast<char*>(next().strings()[0]);
}
template <>
RtFloat* Cursor::take() {
    return changeable(next().floats());
}
template <>
RtFloat (*Cursor::take())[4] {
    return reinterpret_cast<RtFloat(*)[4]>(changeable(next().floats()));
}
template <>
char** Cursor::take() {
    return read_.tokens();
}
template <>
void** Cursor::take() {
    return read_.pointers();
}
template <>
RtFilterFunc Cursor::take() {
    RtFilterFunc named = filter_function(next().string());
    return named ? named : RiGaussianFilter;
}
template <>
RtArchiveCallback Cursor::take() {
    return nullptr;
}

template <class R, class... P>
void call_with(R (*function)(P...), RequestReader& read) {
    [[maybe_unused]] Cursor cursor(read);
    std::apply(function, std::tuple<P...>{cursor.take<P>()...});  // braces: from left to right
}

template <auto function>
void direct(RequestReader& read, Handles&, Report&) {
    call_with(function, read);
}

std::span<const Values> arguments(RequestReader& read) {
    return read.arguments();
}
int* integers(RequestReader& read, size_t at) {
    return changeable(read.arguments()[at].integers());
}
float* floats(RequestReader& read, size_t at) {
    return changeable(read.arguments()[at].floats());
}
char* string(RequestReader& read, size_t at) {
    return const_cast<char*>(read.arguments()[at].strings()[0]);
}
RtInt length(RequestReader& read, size_t at) {
    return RtInt(read.arguments()[at].size());
}

// Lights and objects.

template <auto function>
void make_light(RequestReader& read, Handles& handles, Report&) {
    std::string handle = string(read, 1);  // the call may read another stream
    handles.lights[handle] =
        function(string(read, 0), read.count(), read.tokens(), read.pointers());
}

void object_begin(RequestReader& read, Handles& handles, Report&) {
    std::string handle = string(read, 0);
    handles.objects[handle] = RiObjectBegin();
}

// Null, and a finding: nothing has that handle.
RtPointer find_handle(const HandleMap& handles, std::string_view kind, RequestReader& read,
                      Report& report) {
    auto found = handles.find(arguments(read)[0].string());
    if (found != handles.end() && found->second) return found->second;
    report.add(Code::RIB_HANDLE, read.word(), row(read.request()).name, kind,
               shown(arguments(read)[0].string()));
    return nullptr;
}

void illuminate(RequestReader& read, Handles& handles, Report& report) {
    if (RtPointer light = find_handle(handles.lights, "light", read, report))
        RiIlluminate(light, arguments(read)[1].integer() != 0);
}

void object_instance(RequestReader& read, Handles& handles, Report& report) {
    if (RtPointer object = find_handle(handles.objects, "object", read, report))
        RiObjectInstance(object);
}

// Camera and picture.

// Without arguments the camera is a pinhole.
void depth_of_field(RequestReader& read, Handles&, Report&) {
    if (arguments(read).empty()) return RiDepthOfField(RI_INFINITY, 1, 1);
    call_with(RiDepthOfField, read);
}

void color_samples(RequestReader& read, Handles&, Report&) {
    RiColorSamples(length(read, 0) / 3, floats(read, 0), floats(read, 1));
}

void motion_begin(RequestReader& read, Handles&, Report&) {
    RiMotionBeginV(length(read, 0), floats(read, 0));
}

// `at`: the argument that names the filter.
template <auto function, size_t at>
void with_filter(RequestReader& read, Handles&, Report& report) {
    const std::string_view name = arguments(read)[at].string();
    if (!filter_function(name))
        report.add(Code::RI_TOKEN_WRONG, read.word(), row(read.request()).name, shown(name),
                   filter_names(), "it is taken for \"gaussian\"");
    call_with(function, read);
}

// Primitives.

void polygon(RequestReader& read, Handles&, Report&) {
    RiPolygonV(RtInt(read.vertices()), read.count(), read.tokens(), read.pointers());
}

void points(RequestReader& read, Handles&, Report&) {
    RiPointsV(RtInt(read.vertices()), read.count(), read.tokens(), read.pointers());
}

void general_polygon(RequestReader& read, Handles&, Report&) {
    RiGeneralPolygonV(length(read, 0), integers(read, 0), read.count(), read.tokens(),
                      read.pointers());
}

void points_polygons(RequestReader& read, Handles&, Report&) {
    RiPointsPolygonsV(length(read, 0), integers(read, 0), integers(read, 1), read.count(),
                      read.tokens(), read.pointers());
}

void points_general_polygons(RequestReader& read, Handles&, Report&) {
    RiPointsGeneralPolygonsV(length(read, 0), integers(read, 0), integers(read, 1),
                             integers(read, 2), read.count(), read.tokens(), read.pointers());
}

void hyperboloid(RequestReader& read, Handles&, Report&) {
    std::array<float, 7> numbers;
    std::ranges::transform(arguments(read), numbers.begin(), &Values::real);
    RiHyperboloidV(&numbers[0], &numbers[3], numbers[6], read.count(), read.tokens(),
                   read.pointers());
}

void trim_curve(RequestReader& read, Handles&, Report&) {
    RiTrimCurve(length(read, 0), integers(read, 0), integers(read, 1), floats(read, 2),
                floats(read, 3), floats(read, 4), integers(read, 5), floats(read, 6),
                floats(read, 7), floats(read, 8));
}

void curves(RequestReader& read, Handles&, Report&) {
    RiCurvesV(string(read, 0), length(read, 1), integers(read, 1), string(read, 2), read.count(),
              read.tokens(), read.pointers());
}

void blobby(RequestReader& read, Handles&, Report&) {
    RiBlobbyV(arguments(read)[0].integer(), length(read, 1), integers(read, 1), length(read, 2),
              floats(read, 2), length(read, 3), changeable(arguments(read)[3].strings()),
              read.count(), read.tokens(), read.pointers());
}

void subdivision_mesh(RequestReader& read, Handles&, Report&) {
    bool tags = arguments(read).size() == 7;
    RiSubdivisionMeshV(
        string(read, 0), length(read, 1), integers(read, 1), integers(read, 2),
        tags ? length(read, 3) : 0, tags ? changeable(arguments(read)[3].strings()) : nullptr,
        tags ? integers(read, 4) : nullptr, tags ? integers(read, 5) : nullptr,
        tags ? floats(read, 6) : nullptr, read.count(), read.tokens(), read.pointers());
}

struct ProceduralRow {
    std::string_view name;
    RtProcSubdivFunc function;
};
constexpr ProceduralRow kProcedurals[] = {{"DelayedReadArchive", RiProcDelayedReadArchive},
                                          {"RunProgram", RiProcRunProgram},
                                          {"DynamicLoad", RiProcDynamicLoad}};

// The strings in one block, which RiProcFree() gives back.
RtPointer procedural_data(std::span<const char* const> strings) {
    size_t bytes = strings.size_bytes();
    for (const char* text : strings) bytes += std::strlen(text) + 1;
    char* block = static_cast<char*>(std::malloc(bytes));
    char* to = block + strings.size_bytes();
    for (size_t i = 0; i < strings.size(); ++i) {
        reinterpret_cast<char**>(block)[i] = to;
        to = stpcpy(to, strings[i]) + 1;
    }
    return block;
}

void procedural(RequestReader& read, Handles&, Report& report) {
    auto found = std::ranges::find(kProcedurals, arguments(read)[0].string(), &ProceduralRow::name);
    if (found == std::end(kProcedurals)) {
        report.add(Code::RIB_ARGUMENT, read.word(), "Procedural", "it names no kind of procedural",
                   "");
        return;
    }
    RiProcedural(procedural_data(arguments(read)[1].strings()), floats(read, 2), found->function,
                 RiProcFree);
}

struct HandlerRow {
    std::string_view name;
    RtErrorHandler handler;
};
constexpr HandlerRow kHandlers[] = {
    {"ignore", RiErrorIgnore}, {"print", RiErrorPrint}, {"abort", RiErrorAbort}};

// Where findings are kept rather than told to a handler, a file does not change that: "abort" would
// end the program that reads it.
void error_handler(RequestReader& read, Handles&, Report& report) {
    auto found = std::ranges::find(kHandlers, arguments(read)[0].string(), &HandlerRow::name);
    if (found == std::end(kHandlers)) {
        report.add(Code::RIB_ARGUMENT, read.word(), "ErrorHandler", "it names no handler", "");
        return;
    }
    Context& context = *Context::current();
    bool told = context.handler != nullptr;
    RiErrorHandler(found->handler);
    if (!told) context.handler = nullptr;
}

using Thunk = void (*)(RequestReader&, Handles&, Report&);
struct ThunkRow {
    Request request;
    Thunk call;
};
constexpr ThunkRow kThunkRows[] = {
#include "runtime/scene/ri/bytestream/thunks.def"
};

constexpr auto kThunks = [] {
    std::array<Thunk, std::size(kThunkRows) + 1> thunks{};
    for (const ThunkRow& row : kThunkRows) thunks[size_t(row.request)] = row.call;
    return thunks;
}();
// Of the rows, since addresses of functions are no constants under sanitizers.
constexpr auto kHaveRows = [] {
    std::array<bool, std::size(kThunkRows) + 1> have{};
    for (const ThunkRow& row : kThunkRows) have[size_t(row.request)] = true;
    return have;
}();
static_assert(std::ranges::count(kHaveRows, false) == 1, "a row for each request of RIB");

}  // namespace

const Request* find_called(std::string_view name) {
    const Request* request = find_request(name);
    return request && kThunks[size_t(*request)] ? request : nullptr;
}

void call_request(RequestReader& read, Handles& handles, Report& report) {
    kThunks[size_t(read.request())](read, handles, report);
}

}  // namespace kinora::ri
