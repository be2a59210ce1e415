// runtime/scene/ri/bytestream/read_stream.cpp: streams, request by request.
#include "runtime/scene/ri/bytestream/read_stream.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "runtime/scene/ri/bytestream/call_request_p.h"
#include "runtime/scene/ri/bytestream/lexer_p.h"
#include "runtime/scene/ri/bytestream/report_p.h"
#include "runtime/scene/ri/bytestream/request_reader_p.h"
#include "runtime/scene/ri/bytestream/unzip_p.h"

namespace kinora::ri {
namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";  // that some editors write before a text
constexpr int kDeepest = 64;                            // streams that are read for others

// The context's, while it reads.
class CurrentContext {
  public:
    explicit CurrentContext(Context& context)
        : context_(context), outer_(Context::current()), where_(context.where) {
        Context::make_current(&context);
    }
    ~CurrentContext() {
        Context::make_current(outer_);
        context_.where = where_;
    }

  private:
    Context& context_;
    Context* outer_;
    Location where_;
};

class Stream {
  public:
    Stream(Context& context, Handles& handles, FileId file, const bool& stopped)
        : context_(context),
          handles_(handles),
          stopped_(stopped),
          report_(context, file),
          lexer_(context.diagnostics().files.text(file)),
          reader_(context, lexer_, report_) {}

    // False: no request of the interface stands in it, and something else does.
    bool read();

  private:
    struct Unknown {
        Token first;
        int count = 0;
    };
    void request(const Token& word);
    void version(const Token& word);
    void unknown(const Token& word);
    void skip_to_word();
    void skip_to_request();
    void report_unknown();

    Context& context_;
    Handles& handles_;
    const bool& stopped_;
    Report report_;
    Lexer lexer_;
    RequestReader reader_;
    std::map<std::string, Unknown, std::less<>> unknown_;
    bool known_ = false, other_ = false;  // what was met
};

bool is_request(std::string_view word) {
    return word == "version" || find_called(word);
}

bool Stream::read() {
    while (!stopped_) {
        Token token = lexer_.take();
        if (token.kind == TokenKind::End) break;
        if (token.kind == TokenKind::Word) {
            request(token);
            continue;
        }
        other_ = true;
        bool bad = token.kind == TokenKind::Bad;
        report_.add(bad && token.encoded ? Code::RIB_CODE : Code::RIB_SYNTAX, token,
                    bad ? token.text : "a request is wanted", Report::byte(token));
        skip_to_request();
    }
    report_unknown();
    report_.finish();
    return known_ || !other_;
}

void Stream::request(const Token& word) {
    context_.where = report_.place(word);
    const Request* request = find_called(word.text);
    if (!request) return word.text == "version" ? version(word) : unknown(word);
    known_ = true;
    Outcome outcome = reader_.read(*request, word);
    if (outcome == Outcome::Broken) return skip_to_request();
    if (outcome == Outcome::Read) call_request(reader_, handles_, report_);
    skip_to_word();
}

void Stream::version(const Token& word) {
    known_ = true;
    Token number = lexer_.peek();
    bool read = number.kind == TokenKind::Number;
    if (read) lexer_.take();
    // 3.03 is written as 3.0299988, too.
    if (!read || std::floor(number.number) != 3)
        report_.add(Code::RIB_VERSION, word, read ? fmt::format("{}", number.number) : "");
    skip_to_word();
}

void Stream::unknown(const Token& word) {
    other_ = true;
    constexpr size_t kMostNames = 1000;
    if (unknown_.size() < kMostNames || unknown_.contains(word.text)) {
        Unknown& met = unknown_[shown(word.text)];
        if (met.count++ == 0) met.first = word;
    }
    skip_to_word();
}

void Stream::skip_to_word() {
    TokenKind kind = lexer_.peek().kind;
    for (; kind != TokenKind::Word && kind != TokenKind::End && !stopped_;
         kind = lexer_.peek().kind) {
        lexer_.take();
        lexer_.forget();
    }
}

void Stream::skip_to_request() {
    skip_to_word();
    while (lexer_.peek().kind == TokenKind::Word && !is_request(lexer_.peek().text) && !stopped_) {
        lexer_.take();
        skip_to_word();
    }
}

void Stream::report_unknown() {
    for (const auto& [name, met] : unknown_)
        report_.add(Code::RIB_REQUEST_UNKNOWN, met.first, name, met.count, Report::byte(met.first));
}

// What a stream may begin with.
bool begins_as_rib(std::string_view bytes) {
    constexpr std::string_view kBlanks("\0\t\n\v\f\r ", 7);
    while (!bytes.empty()) {
        bytes.remove_prefix(std::min(bytes.find_first_not_of(kBlanks), bytes.size()));
        if (!bytes.starts_with('#')) break;
        size_t end = std::min(bytes.find_first_of("\r\n"), bytes.size());
        if (bytes.substr(0, end).find("RIB") != bytes.npos) return true;
        bytes.remove_prefix(end);
    }
    Lexer lexer(bytes);
    Token first = lexer.take();
    if (first.kind != TokenKind::Word || !is_request(first.text)) return false;
    // Other files say of what version they are, too: Git's pointers do.
    return first.text != "version" || lexer.take().kind == TokenKind::Number;
}

}  // namespace

bool looks_like_rib(std::string_view bytes) {
    constexpr size_t kEnough = 4096;
    if (bytes.starts_with(kUtf8Mark)) bytes.remove_prefix(kUtf8Mark.size());
    if (is_zipped(bytes)) return begins_as_rib(unzip_beginning(bytes, kEnough));
    return begins_as_rib(bytes.substr(0, kEnough));
}

struct BytestreamReader::State {
    explicit State(Context& c) : context(c) {}

    Context& context;
    Handles handles;
    bool stopped = false;
    int depth = 0;
};

BytestreamReader::BytestreamReader(Context& context) : state_(std::make_unique<State>(context)) {}
BytestreamReader::~BytestreamReader() = default;

void BytestreamReader::stop() {
    state_->stopped = true;
}

bool BytestreamReader::read(const std::string& name, std::string bytes) {
    Context& context = state_->context;
    CurrentContext current(context);
    if (state_->depth == kDeepest) {
        context.error(Code::RIB_DEPTH, name, kDeepest);
        return false;
    }
    Unzipped unzipped = unzip(std::move(bytes));
    bool too_long = unzipped.bytes.size() >= ~uint32_t(0);
    if (too_long) unzipped = {"", "it is longer than 4 GB"};
    if (!unzipped.error.empty()) context.error(Code::RIB_GZIP, name, unzipped.error);
    if (!unzipped.error.empty() && unzipped.bytes.empty()) return false;

    if (unzipped.bytes.starts_with(kUtf8Mark)) unzipped.bytes.erase(0, kUtf8Mark.size());
    FileId file = context.diagnostics().files.add(name, std::move(unzipped.bytes));
    ++state_->depth;
    bool is_rib = Stream(context, state_->handles, file, state_->stopped).read();
    --state_->depth;
    context.where = {file, 0, 0};
    if (!is_rib) context.error(Code::RIB_FOREIGN, name);
    return is_rib;
}

}  // namespace kinora::ri
