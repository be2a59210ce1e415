// runtime/scene/ri/bytestream/parameters.cpp: the parameter list of a request, and as many values
// as its declarations and counts ask for.
#include <algorithm>
#include <array>
#include <utility>

#include "runtime/scene/ri/bytestream/consistency_p.h"
#include "runtime/scene/ri/bytestream/request_reader_p.h"
#include "runtime/scene/ri/calls/accepted_tokens.h"

namespace kinora::ri {
namespace {

// Where points are, and numbers of each.
struct PlaceRow {
    std::string_view name;
    uint32_t components;
};
constexpr PlaceRow kPlaces[] = {{"P", 3}, {"Pw", 4}, {"Pz", 1}};

constexpr Request kNeedPoints[] = {
    Request::Polygon,   Request::GeneralPolygon,        Request::PointsPolygons, Request::Patch,
    Request::PatchMesh, Request::PointsGeneralPolygons, Request::NuPatch,        Request::Points,
    Request::Curves,    Request::SubdivisionMesh};

constexpr size_t kMostParameters = 4096, kLongestName = 4096;

const PlaceRow* find_place(std::string_view name) {
    auto found = std::ranges::find(kPlaces, name, &PlaceRow::name);
    return found == std::end(kPlaces) ? nullptr : found;
}

bool needs_points(Request request) {
    return std::ranges::find(kNeedPoints, request) != std::end(kNeedPoints);
}

// Their names are each renderer's own; those of others change nothing.
bool is_renderers_own(Request request) {
    return request == Request::Option || request == Request::Attribute ||
           request == Request::Hider || request == Request::Display;
}

Values::Kind kind_of(Type type) {
    if (type == Type::Integer) return Values::Kind::Integers;
    return type == Type::String ? Values::Kind::Strings : Values::Kind::Floats;
}

}  // namespace

Outcome RequestReader::read(Request request, const Token& word) {
    lexer_.forget();
    arguments_.clear(), parameters_.clear(), values_.clear();
    tokens_.clear(), pointers_.clear();
    floats_.clear(), integers_.clear(), strings_.clear();
    request_ = request;
    word_ = word;
    vertices_ = 0;
    const RequestRow& form = row(request);
    if (Outcome outcome = read_arguments(form.arguments); outcome != Outcome::Read) return outcome;
    for (const Piece& piece : arguments_) values_.push_back(values(piece));
    if (form.has_parameters()) {
        if (Outcome outcome = read_parameters(); outcome != Outcome::Read) return outcome;
    } else if (lexer_.peek().kind == TokenKind::Bad) {
        syntax_error(lexer_.peek(), "");
    } else if (lexer_.peek().kind != TokenKind::Word && lexer_.peek().kind != TokenKind::End) {
        argument_error(lexer_.peek(), "it has no more arguments; the rest is left out");
    }
    return check();
}

Values RequestReader::values(const Piece& piece) const {
    size_t at = piece.begin;
    if (piece.kind == Values::Kind::Integers)
        return piece.array ? Values(std::span(integers_).subspan(at, piece.count))
                           : Values(integers_[at]);
    if (piece.kind == Values::Kind::Strings)
        return piece.array ? Values(std::span(strings_).subspan(at, piece.count))
                           : Values(strings_[at]);
    return piece.array ? Values(std::span(floats_).subspan(at, piece.count)) : Values(floats_[at]);
}

Outcome RequestReader::read_parameters() {
    bool told = false;
    while (true) {
        const Token& next = lexer_.peek();
        if (next.kind == TokenKind::Word || next.kind == TokenKind::End) return Outcome::Read;
        Outcome outcome = Outcome::Read;
        if (next.kind == TokenKind::String) {
            outcome = read_parameter();
        } else if (next.kind == TokenKind::Bad || next.kind == TokenKind::Close) {
            return syntax_error(next, "a bracket closes nothing");
        } else {
            if (!std::exchange(told, true))
                argument_error(next, "a name of a parameter is wanted; values are left out");
            outcome = skip_value();
        }
        if (outcome == Outcome::Broken) return outcome;
    }
}

Outcome RequestReader::read_parameter() {
    Token token = lexer_.take();
    ReadParameter read{token.text.data(), {}, {}, {}, token};
    std::string_view shader = arguments_.empty() ? "" : shader_of(request_, values_);
    // A binary stream may name a long string again and again by three bytes.
    std::optional<Declaration> declaration;
    if (token.text.size() <= kLongestName)
        declaration = context_.resolve(request_, shader, token.text, read.name);
    if (!declaration) {
        if (!is_renderers_own(request_))
            report_.add(Code::RIB_TOKEN_UNKNOWN, token, name(), shown(token.text));
        TokenKind next = lexer_.peek().kind;
        if (next == TokenKind::Word || next == TokenKind::End) return Outcome::LeftOut;
        return skip_value();
    }
    read.declaration = *declaration;
    Outcome outcome = read_values(kind_of(declaration->type), true, read.values);
    if (outcome != Outcome::Read) return outcome;
    if (parameters_.size() == kMostParameters)
        return argument_error(token, "it has too many parameters; this one is left out");
    parameters_.push_back(read);
    return outcome;
}

// Of requests that do not say how many points they have. False: there are none.
bool RequestReader::count_vertices() {
    for (const ReadParameter& parameter : parameters_)
        if (const PlaceRow* place = find_place(parameter.name)) {
            vertices_ = uint32_t(parameter.values.count / place->components);
            return true;
        }
    return !needs_points(request_);
}

Outcome RequestReader::check() {
    values_.clear();
    for (const Piece& piece : arguments_) values_.push_back(values(piece));
    if (const auto wrong = refusal(request_, values_)) {
        report_.add(Code::RI_TOKEN_WRONG, word_, name(), shown(wrong->token), words_of(*wrong->row),
                    wrong->row->otherwise);
        return Outcome::LeftOut;
    }
    std::string why = contradiction(request_, values_);
    CountedCall counted;
    if (row(request_).kind == RequestClass::Primitive && row(request_).has_parameters()) {
        if (!count_vertices()) {
            report_.add(Code::RI_DATA_MISSING, word_, name(), "P");
            return Outcome::LeftOut;
        }
        counted = count_values(request_, values_, context_.count_state(), vertices_);
        if (why.empty()) why = counted.why;
    }
    if (!why.empty()) {
        report_.add(Code::RI_COUNTS, word_, name(), why);
        return Outcome::LeftOut;
    }
    for (size_t i = 0; i < parameters_.size();) {
        if (fit(parameters_[i], counted.counts)) {
            ++i;
            continue;
        }
        if (find_place(parameters_[i].name) && needs_points(request_)) return Outcome::LeftOut;
        parameters_.erase(parameters_.begin() + std::ptrdiff_t(i));
    }
    finish();
    return Outcome::Read;
}

// False: the parameter has fewer values than it needs.
bool RequestReader::fit(ReadParameter& parameter, const Counts& counts) {
    const Declaration& declaration = parameter.declaration;
    uint64_t wanted = uint64_t(counts.of(declaration.storage)) * declaration.elements() *
                      components(declaration.type, context_.count_state().color_samples);
    uint64_t found = parameter.values.count;
    if (found == wanted) return true;
    bool place = find_place(parameter.name) && needs_points(request_);
    report_.add(Code::RIB_PARAMETER_LENGTH, parameter.at, name(), shown(parameter.name), found,
                wanted,
                found > wanted ? "the rest is left out"
                : place        ? "the primitive is left out"
                               : "it is left out");
    parameter.values.count = size_t(std::min(found, wanted));
    return found > wanted;
}

void RequestReader::finish() {
    for (const ReadParameter& parameter : parameters_) {
        tokens_.push_back(const_cast<char*>(parameter.token));
        pointers_.push_back(pointer(parameter.values));
    }
}

// Not null where there are no values: C takes that for the end of the list.
void* RequestReader::pointer(const Piece& piece) {
    static float none = 0;
    if (piece.count == 0) return &none;
    if (piece.kind == Values::Kind::Integers) return integers_.data() + piece.begin;
    if (piece.kind == Values::Kind::Strings)
        return const_cast<char**>(strings_.data() + piece.begin);
    return floats_.data() + piece.begin;
}

}  // namespace kinora::ri
