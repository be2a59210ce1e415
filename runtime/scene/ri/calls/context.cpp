// runtime/scene/ri/calls/context.cpp: from a C call to a sink.
#include "runtime/scene/ri/calls/context.h"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/calls/accepted_tokens.h"

extern "C" {
RtInt RiLastError = RIE_NOERROR;
}

namespace kinora::ri {
namespace {

struct ErrorRow {
    std::string_view code;
    int error;
};
constexpr ErrorRow kErrors[] = {
    {"RI_NESTING", RIE_NESTING},
    {"RI_OPTION_IN_WORLD", RIE_NOTOPTIONS},
    {"RI_OUTSIDE_WORLD", RIE_NOTPRIMS},
    {"RI_NOT_STARTED", RIE_NOTSTARTED},
    {"RI_MOTION", RIE_BADMOTION},
    {"RI_TOKEN_UNKNOWN", RIE_BADTOKEN},
    {"RI_DECLARATION", RIE_SYNTAX},
    {"RI_RANGE", RIE_RANGE},
    {"RI_COUNTS", RIE_CONSISTENCY},
    {"RI_CONDITION", RIE_SYNTAX},
    {"RI_HANDLE", RIE_BADHANDLE},
    {"RI_SHADER_UNKNOWN", RIE_NOSHADER},
    {"RI_SHADER_REFUSED", RIE_NOSHADER},
    {"RI_TOKEN_WRONG", RIE_BADTOKEN},
    {"RI_DATA_MISSING", RIE_MISSINGDATA},
    {"RI_NOT_DONE", RIE_UNIMPLEMENT},
    {"RI_ARCHIVE", RIE_NOFILE},
    {"RIB_SYNTAX", RIE_SYNTAX},
    {"RIB_PARAMETER_LENGTH", RIE_CONSISTENCY},
    {"RIB_TOKEN_UNKNOWN", RIE_BADTOKEN},
    {"RIB_HANDLE", RIE_BADHANDLE},
    {"RIB_GZIP", RIE_BADFILE},
    {"RIB_CODE", RIE_SYNTAX},
    {"RIB_ARGUMENT", RIE_SYNTAX},
    {"RIB_REQUEST_UNKNOWN", RIE_UNIMPLEMENT},
    {"RIB_NUMBER", RIE_RANGE},
    {"RIB_VERSION", RIE_VERSION},
    {"RIB_DEPTH", RIE_NESTING},
    {"RIB_FOREIGN", RIE_BADFILE},
    {"RIB_MORE", RIE_LIMIT},
    {"RI_MORE", RIE_LIMIT},
    {"RI_MEMORY", RIE_NOMEM},
    {"RI_NOT_WRITTEN", RIE_SYSTEM},
    {"RI_DISPLAY", RIE_NOERROR},
    {"RI_SHADOW_TRACED", RIE_NOERROR},
    {"IMAGE_UNREADABLE", RIE_NOFILE},
    {"POINT_FILE_UNREADABLE", RIE_NOFILE},
    {"SCENE_EMPTY", RIE_MISSINGDATA},
    {"INTERNAL_CHECK", RIE_BUG},
};

int severity_code(Severity severity) {
    switch (severity) {
        case Severity::Error:
            return RIE_ERROR;
        case Severity::Warning:
            return RIE_WARNING;
        default:
            return RIE_INFO;
    }
}

// Values at the pointer of a C call: as many as the declaration and the counts ask.
Values values_at(const void* pointer, const Declaration& declaration, size_t count) {
    switch (declaration.type) {
        case Type::Integer:
            return Values(std::span(static_cast<const int*>(pointer), count));
        case Type::String:
            return Values(std::span(static_cast<const char* const*>(pointer), count));
        default:
            return Values(std::span(static_cast<const float*>(pointer), count));
    }
}

// Arrays whose length is not counted, and so not 0 but for a null pointer.
bool lacks_array(Request request, std::span<const Values> arguments) {
    size_t at = 0;
    for (char letter : row(request).arguments) {
        if (letter == '?') continue;
        if (letter == '*' || at == arguments.size()) break;
        const Values& values = arguments[at++];
        bool fixed = std::string_view("mbcx").find(letter) != std::string_view::npos;
        if (fixed && values.size() == 0) return true;
    }
    return false;
}

bool saves_attributes(Request request) {
    return request == Request::FrameBegin || request == Request::WorldBegin ||
           request == Request::AttributeBegin || request == Request::SolidBegin ||
           request == Request::ObjectBegin || request == Request::ArchiveBegin;
}

bool restores_attributes(Request request) {
    return request == Request::FrameEnd || request == Request::WorldEnd ||
           request == Request::AttributeEnd || request == Request::SolidEnd ||
           request == Request::ObjectEnd || request == Request::ArchiveEnd;
}

// A sink does calls that it kept, or leaves out calls that came here.
bool is_done_by_sink(Request request) {
    return request == Request::ReadArchive || request == Request::ElseIf ||
           request == Request::Else || request == Request::IfEnd;
}

}  // namespace

ErrorCode error_code(const FindingInfo& finding) {
    auto row = std::ranges::find(kErrors, std::string_view(finding.code), &ErrorRow::code);
    int code = row == std::end(kErrors) ? RIE_CONSISTENCY : row->error;
    if (std::string_view(finding.code).starts_with("RSL_")) code = RIE_NOSHADER;
    return {code, severity_code(finding.rendering)};
}

Context::Context(std::unique_ptr<CallSink> sink, Diagnostics& diagnostics)
    : life_(std::make_shared<Life>(this)),
      sink_(std::move(sink)),
      diagnostics_(diagnostics),
      counts_(1) {}

Context::~Context() {
    life_->context = nullptr;
}

std::shared_ptr<Context::Life>& Context::current_life() {
    thread_local std::shared_ptr<Life> life;
    return life;
}

Context* Context::current() {
    const Life* life = current_life().get();
    return life ? life->context.load() : nullptr;
}

void Context::make_current(Context* context) {
    current_life() = context ? context->life_ : nullptr;
}

// A program's own handler is told all; a loop of faulty calls does not fill the terminal.
bool Context::is_printed(const Finding& finding) {
    if (handler != RiErrorPrint || ++printed_[finding.info] <= kMostPrinted) return true;
    ++unprinted_;
    return false;
}

void Context::tell_unprinted() {
    if (unprinted_) error(Code::RI_MORE, std::exchange(unprinted_, 0));
}

void Context::tell(const Finding& finding) {
    ErrorCode told = error_code(*finding.info);
    told.severity = severity_code(finding.severity);
    if (told.severity != RIE_INFO) RiLastError = told.code;
    if (!handler || !is_printed(finding)) return;
    std::string message = finding.message;
    if (finding.where.file != kNoFile) {
        const SourceFiles& files = diagnostics_.files;
        int line = files.line_column(finding.where.file, finding.where.begin).line;
        message = fmt::format("{}:{}: {}", files.name(finding.where.file), line, message);
    }
    handler(told.code, told.severity, message.data());
}

// The handler may make calls; it is not told what is wrong with them, which would not end.
void Context::tell() {
    if (telling_ || told_ >= diagnostics_.findings().size()) return;
    Busy busy(*this);
    telling_ = true;
    const std::vector<Finding> news(diagnostics_.findings().begin() + std::ptrdiff_t(told_),
                                    diagnostics_.findings().end());
    for (const Finding& finding : news) tell(finding);
    telling_ = false;
    if (for_c_program) diagnostics_.clear();
    told_ = diagnostics_.findings().size();
}

// Where memory ends there may be too little for a finding.
void Context::report_exception() try {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        RiLastError = RIE_NOMEM;
        diagnostics_.report(Code::RI_MEMORY, where);
    } catch (const std::exception& mistake) {
        diagnostics_.report(Code::INTERNAL_CHECK, where, mistake.what());
    }
} catch (...) {
    RiLastError = RIE_NOMEM;
}

std::optional<Declaration> Context::resolve(Request request, std::string_view shader,
                                            std::string_view token, std::string_view& name) {
    if (auto inline_one = parse_declaration(token, &name)) return inline_one;
    name = token;
    const bool names_file = request == Request::Display;  // whatever its name is
    std::string scoped =
        fmt::format("{}:{}:{}", row(request).name, names_file ? "" : shader, token);
    for (std::string_view known : {std::string_view(scoped), token}) {
        if (const Declaration* found = declarations_.find(known)) return *found;
        if (const Declaration* found = Declarations::standard().find(known)) return *found;
    }
    if (const Declaration* found = sink_->declared_by_shader(request, shader, token)) return *found;
    return std::nullopt;
}

void Context::send(Request request, std::span<const Values> arguments, int n, RtToken tokens[],
                   RtPointer values[], uint32_t vertices) {
    contained([&] { send_contained(request, arguments, n, tokens, values, vertices); });
}

void Context::send_contained(Request request, std::span<const Values> arguments, int n,
                             RtToken tokens[], RtPointer values[], uint32_t vertices) {
    if (lacks_array(request, arguments))
        return error(Code::RI_DATA_MISSING, row(request).name, "values");
    if (const auto wrong = refusal(request, arguments))
        return error(Code::RI_TOKEN_WRONG, row(request).name, wrong->token, words_of(*wrong->row),
                     wrong->row->otherwise);
    CountedCall counted = count_values(request, arguments, counts_.back(), vertices);
    if (!counted.why.empty()) return error(Code::RI_COUNTS, row(request).name, counted.why);
    // A sink may read an archive during this call, which sends others.
    std::vector<Parameter> parameters = std::move(spare_parameters_);
    parameters.clear();
    std::string_view shader = shader_of(request, arguments);
    for (int i = 0; tokens && values && i < n; ++i) {
        if (!tokens[i] || !values[i]) continue;
        std::string_view name;
        auto declaration = resolve(request, shader, tokens[i], name);
        if (!declaration) {
            error(Code::RI_TOKEN_UNKNOWN, row(request).name, name);
            continue;
        }
        size_t count = size_t(counted.counts.of(declaration->storage)) * declaration->elements() *
                       components(declaration->type, count_state().color_samples);
        parameters.push_back({name, *declaration, values_at(values[i], *declaration, count)});
    }
    follow_blocks(request, arguments);
    sink_->call({request, arguments, parameters, counted.counts, where});
    follow_calls_of_sink(request);
    spare_parameters_ = std::move(parameters);
    tell();
}

void Context::follow_blocks(Request request, std::span<const Values> arguments) {
    if (saves_attributes(request)) counts_.push_back(counts_.back());
    if (restores_attributes(request) && counts_.size() > 1) counts_.pop_back();
    if (request == Request::Basis) {
        counts_.back().ustep = arguments[1].integer();
        counts_.back().vstep = arguments[3].integer();
    }
    if (request == Request::ColorSamples && arguments[0].size() % 3 == 0)
        counts_.back().color_samples = std::max<uint32_t>(1, uint32_t(arguments[0].size() / 3));
}

void Context::follow_calls_of_sink(Request request) {
    if (!is_done_by_sink(request)) return;
    if (std::optional<CountState> now = sink_->count_state()) counts_.back() = *now;
}

RtPointer Context::new_handle() {
    return reinterpret_cast<RtPointer>(uintptr_t(++handles_));
}

int Context::handle_number(RtPointer handle) const {
    auto number = reinterpret_cast<uintptr_t>(handle);
    return number <= uintptr_t(handles_) ? int(number) : 0;
}

}  // namespace kinora::ri
