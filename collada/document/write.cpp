// collada/document/write.cpp: the canonical writer.
#include "collada/document/write.h"

#include <algorithm>
#include <charconv>

#include "collada/document/edit.h"
#include "runtime/base/check.h"

namespace kinora::collada {

namespace {

constexpr std::string_view kSpace = " \t\r\n";

// Elements whose text is numbers wherever COLLADA or profile_RSL have them.
constexpr std::string_view kNumberElements[] = {
    "aspect_ratio",
    "bind_shape_matrix",
    "color",
    "constant_attenuation",
    "falloff_angle",
    "falloff_exponent",
    "float",
    "float2",
    "float3",
    "float3x3",
    "float4",
    "float4x4",
    "float_array",
    "h",
    "int",
    "int_array",
    "linear_attenuation",
    "lookat",
    "matrix",
    "normal",
    "p",
    "point",
    "quadratic_attenuation",
    "rotate",
    "scale",
    "skew",
    "translate",
    "v",
    "vcount",
    "vector",
    "xfov",
    "xmag",
    "yfov",
    "ymag",
    "zfar",
    "znear",
};
static_assert(std::is_sorted(std::begin(kNumberElements), std::end(kNumberElements)));

bool is_private(const Element& e) {
    return e.name == "extra" || (e.name == "technique" && e.attribute("profile"));
}

// The next word of `text` from `at` on, moving `at` behind it; empty at the end.
std::string_view next_word(std::string_view text, size_t& at) {
    size_t begin = text.find_first_not_of(kSpace, at);
    if (begin == text.npos) {
        at = text.size();
        return {};
    }
    size_t end = std::min(text.find_first_of(kSpace, begin), text.size());
    at = end;
    return text.substr(begin, end - begin);
}

bool only_space(std::string_view text) {
    return text.find_first_not_of(kSpace) == text.npos;
}

bool is_number(std::string_view word, double& value) {
    if (word.starts_with("+-")) return false;
    word.remove_prefix(word.starts_with('+'));
    auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    bool inside = error == std::errc() && end == word.data() + word.size();
    return inside && value - value == 0;  // neither NaN nor infinite
}

class Writer {
  public:
    Writer(std::string_view source, Layout layout) : source_(source), layout_(layout) {
        out_.reserve(source.size());
    }

    std::string write(const Document& document) {
        bool declared = layout_ != Layout::Dense || source_.starts_with("<?xml");
        if (declared) out_ = "<?xml version=\"1.0\"";
        if (layout_ != Layout::Dense) out_ += " encoding=\"utf-8\"";  // the default
        if (declared) out_ += "?>";
        if (declared) end_line();
        const Element& root = document.root();
        misc(0, root.bytes.begin, 0);
        element(root, 0, false);
        misc(root.bytes.end, uint32_t(source_.size()), 0);
        return std::move(out_);
    }

  private:
    std::string_view bytes(uint32_t begin, uint32_t end) const {
        return source_.substr(begin, end - begin);
    }
    void indent(int depth) {
        if (layout_ == Layout::Indented) out_.append(size_t(depth) * 2, ' ');
    }
    void end_line() {
        if (layout_ != Layout::Dense) out_ += '\n';
    }

    // As in the file, but line feeds alone.
    void copy(std::string_view text) {
        for (size_t i = 0; i < text.size(); ++i) {
            bool pair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
            if (!pair) out_ += text[i] == '\r' ? '\n' : text[i];
        }
    }

    // Comments and processing instructions of bytes that hold no element and no text.
    void misc(uint32_t begin, uint32_t end, int depth) {
        struct Kind {
            std::string_view open, close;
        };
        static constexpr Kind kKinds[] = {{"<!--", "-->"}, {"<?", "?>"}};
        std::string_view gap = bytes(begin, end);
        for (size_t at = 0; (at = gap.find('<', at)) != gap.npos;) {
            const Kind* kind = nullptr;
            for (const Kind& k : kKinds)
                if (gap.substr(at).starts_with(k.open)) kind = &k;
            size_t close = kind ? gap.find(kind->close, at + kind->open.size()) : gap.npos;
            if (close == gap.npos) {
                ++at;  // a document type, or CDATA with white space
                continue;
            }
            size_t after = close + kind->close.size();
            std::string_view whole = gap.substr(at, after - at);
            bool declaration = whole.starts_with("<?xml") && kSpace.find(whole[5]) != kSpace.npos;
            if (!declaration) {
                indent(depth);
                copy(whole);
                end_line();
            }
            at = after;
        }
    }

    // The name with its prefix: also such prefixes as the Document leaves out.
    std::string_view full_name(const Element& e) const {
        std::string_view tag = bytes(e.start_tag.begin + 1, e.start_tag.end);
        return tag.substr(0, tag.find_first_of(" \t\r\n/>"));
    }

    // Where the content ends: the start of the end tag.
    uint32_t content_end(const Element& e) const {
        if (e.bytes.end == e.start_tag.end) return e.start_tag.end;
        return uint32_t(source_.rfind("</", e.bytes.end - 1));
    }

    bool has_misc(const Element& e) const {
        uint32_t end = content_end(e);
        if (e.first_child) return true;
        std::string_view content = bytes(e.start_tag.end, end);
        // CDATA may hold what looks like a comment: then the copy is as good.
        return content.find("<!--") != content.npos || content.find("<?") != content.npos;
    }

    bool copied(const Element& e) const {
        if (e.value("xml:space") == "preserve") return true;
        return !only_space(e.text) && has_misc(e) && !in_one_cdata(e);
    }

    // <code><![CDATA[ ... ]]></code>: what stands inside is text, whatever it looks like.
    bool in_one_cdata(const Element& e) const {
        if (e.first_child) return false;
        std::string_view content = bytes(e.start_tag.end, content_end(e));
        size_t begin = content.find_first_not_of(kSpace);
        size_t end = content.find_last_not_of(kSpace);
        if (begin == content.npos) return false;
        content = content.substr(begin, end + 1 - begin);
        return content.starts_with("<![CDATA[") && content.find("]]>") == content.size() - 3;
    }

    void element(const Element& e, int depth, bool is_private_data) {
        indent(depth);
        if (copied(e)) {
            copy(bytes(e.bytes.begin, e.bytes.end));
            end_line();
            return;
        }
        std::string_view name = full_name(e);
        (out_ += '<') += name;
        for (const Attribute& a : e.attributes) {
            // The name in the file has its prefix.
            std::string_view written = bytes(a.bytes.begin, a.bytes.end);
            written = written.substr(0, written.find_first_of(" \t\r\n="));
            (out_ += ' ') += attribute_text(written, a.value);
        }
        size_t tag_end = out_.size();
        out_ += '>';
        size_t content = out_.size();
        if (!only_space(e.text))
            text(e, is_private_data);
        else
            children(e, depth, is_private_data || is_private(e));
        if (out_.size() == content) {
            out_.resize(tag_end);
            out_ += "/>";
            end_line();
            return;
        }
        if (out_.back() == '\n' && only_space(e.text)) indent(depth);
        ((out_ += "</") += name) += '>';
        end_line();
    }

    void children(const Element& e, int depth, bool is_private_data) {
        size_t begin = out_.size();
        end_line();
        size_t first = out_.size();
        uint32_t at = e.start_tag.end;
        for (const Element& child : e.children()) {
            misc(at, child.bytes.begin, depth + 1);
            element(child, depth + 1, is_private_data);
            at = child.bytes.end;
        }
        misc(at, content_end(e), depth + 1);
        if (out_.size() == first) out_.resize(begin);
    }

    void text(const Element& e, bool is_private_data) {
        bool numbers = !is_private_data && std::binary_search(std::begin(kNumberElements),
                                                              std::end(kNumberElements), e.name);
        if (numbers) return number_list(e.text);
        bool markup = e.text.find_first_of("<&") != e.text.npos;
        bool lines = e.text.find('\n') != e.text.npos;
        bool returns = e.text.find('\r') != e.text.npos;
        out_ += markup && lines && !returns ? cdata(e.text) : escape_text(e.text);
    }

    void number_list(std::string_view list) {
        bool first = true;
        for (size_t at = 0; at < list.size();) {
            std::string_view word = next_word(list, at);
            if (word.empty()) break;
            if (!first) out_ += ' ';
            first = false;
            double value;
            out_ += is_number(word, value) ? shortest_number(word) : escape_text(word);
        }
    }

    std::string_view source_;
    Layout layout_;
    std::string out_;
};

std::string path_of(const Element& e) {
    std::string path = e.parent ? path_of(*e.parent) + "/" : "";
    path += e.name;
    if (std::string_view id = e.value("id"); !id.empty()) (path += '#') += id;
    return path;
}

bool same_numbers(std::string_view a, std::string_view b) {
    size_t at = 0, bt = 0;
    for (;;) {
        std::string_view x = next_word(a, at), y = next_word(b, bt);
        if (x.empty() || y.empty()) return x.empty() && y.empty();
        double p, q;
        bool numbers = is_number(x, p) && is_number(y, q);
        if (!(numbers ? p == q : x == y)) return false;
    }
}

bool same_text(const Element& a, const Element& b) {
    if (a.text == b.text || (only_space(a.text) && only_space(b.text))) return true;
    return holds_numbers(a) && same_numbers(a.text, b.text);
}

bool same_attributes(const Element& a, const Element& b) {
    if (a.attributes.size() != b.attributes.size()) return false;
    return std::all_of(a.attributes.begin(), a.attributes.end(), [&](const Attribute& x) {
        const Attribute* y = b.attribute(x.name);
        return y && y->value == x.value;
    });
}

bool equal_elements(const Element& a, const Element& b, std::string* difference) {
    const char* what = nullptr;
    if (a.name != b.name)
        what = "name";
    else if (!same_attributes(a, b))
        what = "attributes";
    else if (!same_text(a, b))
        what = "text";
    if (what) {
        if (difference) *difference = path_of(a) + ": " + what;
        return false;
    }
    const Element* y = b.first_child;
    for (const Element& x : a.children()) {
        if (!y) {
            if (difference) *difference = path_of(x) + ": is not in the other";
            return false;
        }
        if (!equal_elements(x, *y, difference)) return false;
        y = y->next;
    }
    if (y && difference) *difference = path_of(*y) + ": is only in the other";
    return !y;
}

}  // namespace

std::string shortest_number(double value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string shortest_number(std::string_view token) {
    double value;
    if (!is_number(token, value)) return std::string(token);
    if (token.find_first_not_of("+-0123456789") != token.npos) return shortest_number(value);
    // An integer, perhaps of a type that knows no exponents, perhaps larger than doubles are exact.
    bool minus = token.front() == '-';
    token.remove_prefix(std::min(token.find_first_not_of("+-0"), token.size() - 1));
    return minus ? "-" + std::string(token) : std::string(token);
}

bool in_private_data(const Element& element) {
    for (const Element* e = element.parent; e; e = e->parent)
        if (is_private(*e)) return true;
    return false;
}

bool holds_numbers(const Element& element) {
    return !in_private_data(element) &&
           std::binary_search(std::begin(kNumberElements), std::end(kNumberElements), element.name);
}

std::string write(const Document& document, const SourceFiles& files, Layout layout) {
    CHECK(document.whole());
    return Writer(files.text(document.file()), layout).write(document);
}

bool equal(const Document& a, const Document& b, std::string* difference) {
    return equal_elements(a.root(), b.root(), difference);
}

}  // namespace kinora::collada
