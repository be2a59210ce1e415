// runtime/scene/ri/bytestream/request_reader_p.h: the arguments and parameters of one request.
#pragma once

#include <string_view>
#include <vector>

#include "runtime/scene/ri/bytestream/lexer_p.h"
#include "runtime/scene/ri/bytestream/report_p.h"
#include "runtime/scene/ri/calls/call.h"
#include "runtime/scene/ri/calls/context.h"

namespace kinora::ri {

// Values in the reader's arrays.
struct Piece {
    Values::Kind kind = Values::Kind::Floats;
    bool array = true;
    size_t begin = 0, count = 0;
};

struct ReadParameter {
    const char* token;      // as it stands in the stream
    std::string_view name;  // without an inline declaration
    Declaration declaration;
    Piece values;
    Token at;
};

enum class Outcome : uint8_t {
    Read,
    LeftOut,  // cannot be used; what follows can be read
    Broken,   // the stream is wrong here
};

class RequestReader {
  public:
    RequestReader(Context& context, Lexer& lexer, Report& report)
        : context_(context), lexer_(lexer), report_(report) {}

    // Reads what stands behind the word, and checks it. What is wrong has been reported.
    Outcome read(Request request, const Token& word);

    // What was read, until the next read().
    Request request() const { return request_; }
    const Token& word() const { return word_; }
    std::span<const Values> arguments() const { return values_; }
    // Parameters as the C functions take them.
    int count() const { return int(tokens_.size()); }
    char** tokens() { return tokens_.data(); }
    void** pointers() { return pointers_.data(); }
    uint32_t vertices() const { return vertices_; }  // those of "P"

  private:
    std::string_view name() const { return row(request_).name; }
    Outcome argument_error(const Token& at, std::string_view what);
    Outcome syntax_error(const Token& at, std::string_view what);

    // arguments.cpp
    Outcome read_arguments(std::string_view letters);
    Outcome read_argument(char letter, bool last);
    Outcome read_group(std::string_view letters);
    Outcome collect_numbers(size_t wanted);
    void store_group(std::string_view letters);
    Outcome read_string();
    Outcome read_handle();
    Outcome read_basis();
    bool more_arguments();
    int whole(double value);

    // Values of one kind, in brackets or bare; `several`: bare ones go on while numbers come.
    Outcome read_values(Values::Kind kind, bool several, Piece& piece);
    template <class T>
    Outcome read_numbers(std::vector<T>& values, bool several);
    Outcome read_strings();
    Outcome read_element(std::vector<const char*>& values);
    template <class T>
    Outcome read_element(std::vector<T>& values);
    void push(std::vector<float>& values, const Token& number);
    void push(std::vector<int>& values, const Token& number);
    template <class T>
    void push_all(std::vector<T>& values, const Token& floats);
    Outcome skip_value();

    // parameters.cpp
    Outcome read_parameters();
    Outcome read_parameter();
    Outcome check();
    bool count_vertices();
    bool fit(ReadParameter& parameter, const Counts& counts);
    void finish();
    Values values(const Piece& piece) const;
    void* pointer(const Piece& piece);

    Context& context_;
    Lexer& lexer_;
    Report& report_;

    Request request_{};
    Token word_;
    std::vector<Piece> arguments_;
    std::vector<ReadParameter> parameters_;
    std::vector<Values> values_;
    std::vector<char*> tokens_;
    std::vector<void*> pointers_;
    uint32_t vertices_ = 0;
    // All values of the request.
    std::vector<float> floats_;
    std::vector<int> integers_;
    std::vector<const char*> strings_;
    std::vector<double> group_;  // numbers that may stand alone or in brackets
    bool fraction_ = false;      // one was met where whole numbers are wanted
    bool wrong_kind_ = false;    // strings among numbers, or numbers among strings
    bool non_finite_told_ = false;
};

}  // namespace kinora::ri
