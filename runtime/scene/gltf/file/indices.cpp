// runtime/scene/gltf/file/indices.cpp: one walk over a glTF's JSON beside the table of its indices.
#include "runtime/scene/gltf/file/indices.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <iterator>
#include <map>

#include "runtime/scene/gltf/file/file.h"
#include "runtime/scene/gltf/file/json_scanner_p.h"

namespace kinora {

namespace {

constexpr char kObject[] = "object";

struct Row {
    const char* path;
    const char* list;  // null: the path itself must be a list, or an object
    const char* name;
    bool or_none = false;
};

constexpr Row kRows[] = {
#define INDEX(path, list, name) {path, list, name},
#define INDEX_OR_NONE(path, list, name) {path, list, name, true},
#define LIST(path) {path, nullptr, nullptr},
#define OBJECT(path) {path, nullptr, kObject},
#include "runtime/scene/gltf/file/indices.def"
};

using RowSet = uint64_t;
static_assert(std::size(kRows) <= 64);

constexpr size_t kQuotedValue = 24;  // characters of a value that a finding holds

std::vector<std::string_view> tokens_of(std::string_view path) {
    std::vector<std::string_view> tokens;
    while (!path.empty()) {
        path.remove_prefix(1);
        const size_t slash = std::min(path.find('/'), path.size());
        tokens.push_back(path.substr(0, slash));
        path.remove_prefix(slash);
    }
    return tokens;
}

const std::vector<std::vector<std::string_view>>& row_tokens() {
    static const std::vector<std::vector<std::string_view>> tokens = [] {
        std::vector<std::vector<std::string_view>> all;
        for (const Row& row : kRows) all.push_back(tokens_of(row.path));
        return all;
    }();
    return tokens;
}

std::string_view last_token(const Row& row) {
    const std::string_view path = row.path;
    return path.substr(path.rfind('/') + 1);
}

bool matches(std::string_view token, const std::string* key) {
    if (!key || token == "*") return !key && token == "*";
    if (token.starts_with('?')) return key->ends_with(token.substr(1));
    return token == *key;
}

// The rows of `rows` whose token at that depth fits; `key` is null for an element.
RowSet matching(RowSet rows, size_t depth, const std::string* key) {
    RowSet found = 0;
    for (RowSet left = rows; left != 0; left &= left - 1) {
        const size_t row = size_t(std::countr_zero(left));
        const std::vector<std::string_view>& tokens = row_tokens()[row];
        if (depth < tokens.size() && matches(tokens[depth], key)) found |= RowSet(1) << row;
    }
    return found;
}

class IndexWalk {
  public:
    explicit IndexWalk(std::string_view json) : json_(json), scanner_(json) {}
    GltfIndices run() {
        value(~RowSet(0) >> (64 - std::size(kRows)));
        if (!found_.mended.empty()) found_.mended += json_.substr(copied_);
        return std::move(found_);
    }

  private:
    struct Step {
        size_t begin;  // of the value
        std::string token;
    };

    // One value, at which these rows have matched so far; false at the end of the text.
    bool value(RowSet rows) {
        const size_t begin = (scanner_.peek(), scanner_.at());
        RowSet below = rows;
        for (RowSet left = rows; left != 0; left &= left - 1) {
            const size_t row = size_t(std::countr_zero(left));
            if (row_tokens()[row].size() != path_.size()) continue;
            if (kRows[row].list) return index(kRows[row], begin);
            if (kRows[row].name) {
                if (scanner_.peek() != '{') return no_object(begin);
                below &= ~(RowSet(1) << row);
                continue;
            }
            if (scanner_.peek() != '[' && found_.not_a_list.empty()) found_.not_a_list = pointer();
            below &= ~(RowSet(1) << row);
        }
        if (scanner_.peek() == '[' && below != 0) return elements(below);
        return scanner_.peek() == '{' && below != 0 ? members(below) : scanner_.skip_value();
    }

    bool index(const Row& row, size_t begin) {
        const bool whole = scanner_.skip_value();
        if (whole) check(row, {uint32_t(begin), uint32_t(scanner_.at())});
        return whole;
    }

    bool no_object(size_t begin) {
        const bool whole = scanner_.skip_value();
        if (whole) replace({uint32_t(begin), uint32_t(scanner_.at())}, nullptr, "{}");
        return whole;
    }

    bool elements(RowSet rows) {
        scanner_.take('[');
        const RowSet below = matching(rows, path_.size(), nullptr);
        for (size_t i = 0; scanner_.peek() != ']'; ++i) {
            if (!enter(std::to_string(i), below)) return false;
            if (!scanner_.take(',') && scanner_.peek() != ']') return false;
        }
        return scanner_.take(']');
    }

    bool members(RowSet rows) {
        scanner_.take('{');
        const Row* missing = member_or_none(rows);
        bool is_empty = true;
        while (std::optional<JsonRange> name = scanner_.string()) {
            is_empty = false;
            SourceMap map;
            std::string key = json_string(json_, *name, kNoFile, map);
            if (!scanner_.take(':')) return false;
            const RowSet below = matching(rows, path_.size(), &key);
            if (missing && key == last_token(*missing)) missing = nullptr;
            if (!enter(std::move(key), below)) return false;
            if (!scanner_.take(',')) break;
        }
        if (scanner_.peek() != '}') return false;
        if (missing) add_none(*missing, is_empty);
        return scanner_.take('}');
    }

    // The row of a member that the object has or gets; null where there is none.
    const Row* member_or_none(RowSet rows) const {
        for (RowSet left = rows; left != 0; left &= left - 1) {
            const size_t row = size_t(std::countr_zero(left));
            if (kRows[row].or_none && row_tokens()[row].size() == path_.size() + 1)
                return &kRows[row];
        }
        return nullptr;
    }

    // At the end of the object.
    void add_none(const Row& row, bool is_first) {
        copy_to(scanner_.at());
        found_.mended +=
            fmt::format("{}\"{}\":{}", is_first ? "" : ",", last_token(row), kNoGltfIndex);
    }

    void copy_to(size_t end) {
        found_.mended += json_.substr(copied_, end - copied_);
        copied_ = end;
    }

    bool enter(std::string token, RowSet rows) {
        if (rows == 0) return scanner_.skip_value();
        path_.push_back({(scanner_.peek(), scanner_.at()), std::move(token)});
        const bool whole = value(rows);
        path_.pop_back();
        return whole;
    }

    std::string pointer() const {
        std::string text;
        for (const Step& step : path_) {
            text += '/';
            for (char c : step.token) text += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
        }
        return text;
    }

    void check(const Row& row, JsonRange range) {
        const std::string_view text = json_.substr(range.begin, range.end - range.begin);
        size_t number = 0;
        const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error == std::errc() && rest == text.data() + text.size() &&
            number < list_size(row.list))
            return;
        replace(range, row.name, kNoGltfIndex);
    }

    void replace(JsonRange range, const char* name, std::string_view with) {
        const std::string_view text = json_.substr(range.begin, range.end - range.begin);
        if (found_.fault_count++ < kMaxGltfFindings)
            found_.faults.push_back(
                {pointer(), name, std::string(text.substr(0, kQuotedValue)), range});
        copy_to(range.begin);
        found_.mended += with;
        copied_ = range.end;
    }

    size_t list_size(std::string_view list) {
        const size_t star = list.find("/*/");
        if (star != std::string_view::npos) return own_size(list.substr(star + 2));
        auto [known, is_new] = sizes_.try_emplace(list, 0);
        if (is_new) known->second = json_elements(json_, list).size();
        return known->second;
    }

    // Of a list in the element of a list of the file that the walk is in.
    size_t own_size(std::string_view list) {
        const size_t begin = path_[1].begin;
        if (own_begin_ != begin) own_size_ = json_elements(json_.substr(begin), list).size();
        own_begin_ = begin;
        return own_size_;
    }

    std::string_view json_;
    JsonScanner scanner_;
    std::vector<Step> path_;
    std::map<std::string_view, size_t> sizes_;
    size_t own_begin_ = 0, own_size_ = 0;
    size_t copied_ = 0;  // bytes of json_ that are in found_.mended
    GltfIndices found_;
};

}  // namespace

GltfIndices check_gltf_indices(std::string_view json) {
    return IndexWalk(json).run();
}

}  // namespace kinora
