// runtime/scene/ri/bytestream/stream_words.cpp: ASCII and binary (RI Specification 3.2, table C.1).
#include "runtime/scene/ri/bytestream/stream_words_p.h"

#include <fmt/format.h>

#include <bit>
#include <bitset>
#include <cmath>
#include <map>
#include <utility>

#include "collada/text/number_run.h"

namespace kinora::ri {
namespace {

// The shortest digits that are read as the same number.
void append_float(std::string& text, float value) {
    size_t at = text.size();
    fmt::format_to(std::back_inserter(text), "{}", value);
    if (!std::isfinite(value)) return;
    // Readers round twice, to double and to float.
    double read = 0;
    collada::scan_number(text.data() + at, text.data() + text.size(), read);
    if (float(read) == value) return;
    text.resize(at);
    fmt::format_to(std::back_inserter(text), "{:.9g}", value);
}

struct EscapeRow {
    char meaning, letter;
};
constexpr EscapeRow kLetters[] = {{'\n', 'n'}, {'\r', 'r'}, {'\t', 't'}, {'\b', 'b'},
                                  {'\f', 'f'}, {'"', '"'},  {'\\', '\\'}};

class AsciiWords : public StreamWords {
  public:
    void begin_request(Request request, int depth) override {
        text.append(size_t(depth) * 4, ' ');
        text += row(request).name;
        first_ = false;
    }
    void end_request() override { text += '\n'; }
    void add(int value) override {
        space();
        fmt::format_to(std::back_inserter(text), "{}", value);
    }
    void add(float value) override {
        space();
        append_float(text, value);
    }
    void add(std::string_view string) override {
        space();
        text += '"';
        for (char c : string) add_character(c);
        text += '"';
    }
    void add(std::span<const float> values) override { add_array(values); }
    void add_token(std::string_view name) override { add(name); }

  protected:
    void open() override {
        space();
        text += '[';
        first_ = true;
    }
    void close() override {
        text += ']';
        first_ = false;
    }

  private:
    void space() {
        if (!std::exchange(first_, false)) text += ' ';
    }
    void add_character(char c) {
        for (const EscapeRow& row : kLetters)
            if (row.meaning == c) {
                text += '\\';
                text += row.letter;
                return;
            }
        if (uint8_t(c) < ' ')
            fmt::format_to(std::back_inserter(text), "\\{:03o}", int(c));
        else
            text += c;
    }

    bool first_ = false;  // in its brackets
};

class BinaryWords : public StreamWords {
  public:
    void begin_request(Request request, int) override {
        size_t code = size_t(request);
        if (!defined_[code]) {
            byte(0314), byte(code);
            add(row(request).name);
            defined_[code] = true;
        }
        byte(0246), byte(code);
    }
    void end_request() override {}
    void add(int value) override {
        size_t count = 1;
        while (count < 4 && value != value << (32 - 8 * count) >> (32 - 8 * count)) ++count;
        byte(0200 + count - 1);
        bytes(uint32_t(value), count);
    }
    void add(float value) override {
        byte(0244);
        bytes(std::bit_cast<uint32_t>(value), 4);
    }
    void add(std::string_view string) override {
        if (string.size() <= 15)
            byte(0220 + string.size());
        else
            counted(0240, string.size());
        text += string;
    }
    void add(std::span<const float> values) override {
        counted(0310, values.size());
        for (float value : values) bytes(std::bit_cast<uint32_t>(value), 4);
    }
    void add_token(std::string_view name) override {
        auto known = tokens_.find(name);
        if (known == tokens_.end() && tokens_.size() == kMostTokens) return add(name);
        if (known == tokens_.end()) {
            known = tokens_.emplace(name, tokens_.size()).first;
            number(0315, known->second);
            add(name);
        }
        number(0317, known->second);
    }

  protected:
    void open() override { text += '['; }
    void close() override { text += ']'; }

  private:
    static constexpr size_t kMostTokens = 65536;

    void byte(size_t value) { text += char(value); }
    // The highest first.
    void bytes(uint64_t value, size_t count) {
        for (size_t i = count; i-- > 0;) byte(value >> (8 * i) & 0xFF);
    }
    void counted(size_t code, size_t count) {
        size_t length = count < 1u << 8 ? 1 : count < 1u << 16 ? 2 : count < 1u << 24 ? 3 : 4;
        byte(code + length - 1);
        bytes(count, length);
    }
    void number(size_t code, size_t token) {
        byte(code + (token > 0xFF));
        bytes(token, token > 0xFF ? 2 : 1);
    }

    std::bitset<256> defined_;
    std::map<std::string, size_t, std::less<>> tokens_;
};

}  // namespace

std::unique_ptr<StreamWords> ascii_words() {
    return std::make_unique<AsciiWords>();
}
std::unique_ptr<StreamWords> binary_words() {
    return std::make_unique<BinaryWords>();
}

}  // namespace kinora::ri
