// runtime/kinora/frame_list.cpp: frame ranges, frame rates, numbered file names.
#include "runtime/kinora/frame_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <unordered_set>

namespace kinora {

namespace {

constexpr int64_t kLargestFrame = 1'000'000'000'000;  // times kLargestRate it fits int64
constexpr int64_t kLargestRate = 1'000'000;

// Reads a whole number at the front of `text` and takes it off.
bool take_number(std::string_view& text, int64_t& number) {
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || number < -kLargestFrame || number > kLargestFrame) return false;
    text.remove_prefix(size_t(end - text.data()));
    return true;
}

bool take(std::string_view& text, std::string_view token) {
    if (!text.starts_with(token)) return false;
    text.remove_prefix(token.size());
    return true;
}

// One of "7", "1-9", "1..9", "1:9", each with an optional "x2" or ":2".
bool parse_range(std::string_view text, std::vector<int64_t>& frames, std::string& error) {
    std::string_view whole = text;
    int64_t first = 0, last = 0, step = 0;
    if (!take_number(text, first)) {
        error = fmt::format("'{}' is no frame range", whole);
        return false;
    }
    last = first;
    bool range = take(text, "..") || take(text, "-") || take(text, ":");
    bool ok = !range || take_number(text, last);
    bool stepped = ok && (take(text, "x") || take(text, ":"));
    ok = ok && (!stepped || take_number(text, step)) && text.empty();
    if (!ok) {
        error = fmt::format("'{}' is no frame range; write 1-240, 1-240x2 or 12", whole);
        return false;
    }
    if (stepped && step == 0) {
        error = fmt::format("'{}' has a step of 0", whole);
        return false;
    }
    if (!stepped) step = last >= first ? 1 : -1;
    bool away = (step > 0) != (last >= first) && last != first;  // it never gets there
    int64_t count = away ? 0 : (last - first) / step + 1;
    if (count > kMostFrames || int64_t(frames.size()) + count > kMostFrames) {
        error = fmt::format("'{}' is more than {} frames", whole, kMostFrames);
        return false;
    }
    for (int64_t i = 0; i < count; ++i) frames.push_back(first + i * step);
    return true;
}

}  // namespace

std::optional<std::vector<int64_t>> parse_frames(std::string_view text, std::string& error) {
    std::vector<int64_t> frames;
    while (true) {
        size_t comma = text.find(',');
        if (!parse_range(text.substr(0, comma), frames, error)) return std::nullopt;
        if (comma == std::string_view::npos) break;
        text.remove_prefix(comma + 1);
    }
    if (frames.empty()) {
        error = "the range names no frame";
        return std::nullopt;
    }
    std::unordered_set<int64_t> seen;
    std::erase_if(frames, [&](int64_t frame) { return !seen.insert(frame).second; });
    return frames;
}

std::string frame_ranges(std::vector<int64_t> frames) {
    std::ranges::sort(frames);
    std::string text;
    for (size_t i = 0; i < frames.size();) {
        size_t last = i;
        while (last + 1 < frames.size() && frames[last + 1] == frames[last] + 1) ++last;
        text += text.empty() ? "" : ", ";
        text += last == i ? fmt::format("{}", frames[i])
                          : fmt::format("{}-{}", frames[i], frames[last]);
        i = last + 1;
    }
    return text;
}

FrameRate frame_rate_of(double value) {
    double rounded = std::round(value);
    if (rounded >= 1 && std::abs(value - rounded) < 1e-9) return {int64_t(rounded), 1};
    double ntsc = std::ceil(value);  // 23.976 is 24000/1001
    if (std::abs(value - ntsc * 1000.0 / 1001.0) < 0.005) return {int64_t(ntsc) * 1000, 1001};
    return {std::max<int64_t>(1, std::llround(value * 1000.0)), 1000};
}

std::optional<FrameRate> parse_frame_rate(std::string_view text) {
    FrameRate rate;
    std::string_view rest = text;
    if (take_number(rest, rate.numerator) && take(rest, "/")) {
        bool ok = take_number(rest, rate.denominator) && rest.empty() && rate.numerator > 0 &&
                  rate.denominator > 0 && rate.numerator <= kLargestRate &&
                  rate.denominator <= kLargestRate;
        return ok ? std::optional(rate) : std::nullopt;
    }
    double value = 0;
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    if (!(value > 0) || value > double(kLargestRate)) return std::nullopt;
    return frame_rate_of(value);
}

OutputName::OutputName(std::string pattern) : before_(std::move(pattern)) {
    // A token stands in the file's name, not in its folder's.
    size_t name = before_.rfind('/') + 1;
    size_t hash = before_.find_last_of('#');
    if (hash != std::string::npos && hash >= name) {
        size_t first = hash;
        while (first > name && before_[first - 1] == '#') --first;
        digits_ = int(hash - first + 1);
        after_ = before_.substr(hash + 1);
        before_ = before_.substr(0, first);
        return;
    }
    size_t percent = before_.rfind('%');
    if (percent == std::string::npos || percent < name) return;
    size_t d = before_.find('d', percent);
    if (d == std::string::npos) return;
    int width = 1;
    if (d > percent + 1) {
        auto [end, error] =
            std::from_chars(before_.data() + percent + 1, before_.data() + d, width);
        if (error != std::errc() || end != before_.data() + d || width < 1 || width > 20) return;
    }
    digits_ = width;
    after_ = before_.substr(d + 1);
    before_ = before_.substr(0, percent);
}

std::string OutputName::file(int64_t frame) const {
    return before_ + number(frame) + after_;
}

std::string OutputName::number(int64_t frame) const {
    if (digits_ == 0) return "";
    return fmt::format("{}{:0{}}", frame < 0 ? "-" : "", frame < 0 ? -frame : frame, digits_);
}

}  // namespace kinora
