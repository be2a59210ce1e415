// runtime/player/script.cpp: lines to commands; waiting, and what is expected.
#include "runtime/player/script.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "runtime/base/stats.h"
#include "runtime/player/pixel/pixel_story.h"
#include "runtime/player/scene_maker.h"
#include "runtime/scene/load/override_scene.h"

namespace kinora {

namespace {

constexpr double kPatience = 3600;  // seconds that a picture may take
constexpr double kTick = 1.0 / 120;

std::optional<double> one_number(const std::string& text) {
    auto numbers = parse_numbers(text);
    if (!numbers || numbers->size() != 1) return std::nullopt;
    return numbers->front();
}

CommandResult bad(std::string message, size_t word) {
    return {false, std::move(message), word};
}

CommandResult unknown(const std::string& kind, const Words& words, size_t k,
                      const std::vector<std::string_view>& known) {
    std::string word = k < words.texts.size() ? words.texts[k] : "";
    std::string_view near = nearest_name(word, known);
    return bad(fmt::format("{} takes {}{}", kind, fmt::join(known, ", "),
                           near.empty() ? "" : fmt::format("; did you mean {}?", near)),
               k);
}

}  // namespace

Script::Script(Player& player, std::string name, std::function<void(const std::string&)> report)
    : player_(player), name_(std::move(name)), report_(std::move(report)) {}

bool Script::run(std::string_view text) {
    for (number_ = 1; !text.empty(); ++number_) {
        size_t end = std::min(text.find('\n'), text.size());
        Words words = split_words(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (words.texts.empty()) continue;
        if (!finish(words, words.error.empty() ? line(words) : CommandResult{})) return false;
    }
    return true;
}

// False after a report.
bool Script::finish(const Words& words, const CommandResult& result) {
    CommandResult shown = words.error.empty() ? result : bad(words.error, words.texts.size() - 1);
    if (shown.done) return true;
    size_t word = std::min(shown.argument, words.columns.size() - 1);
    report_(fmt::format("{}:{}:{}: error: {}", name_, number_, words.columns[word], shown.message));
    return false;
}

Script::Progress Script::step(std::string_view text) {
    if (!since_) {
        ++number_;
        since_.emplace();
    }
    Words words = split_words(text);
    if (words.error.empty() && !words.texts.empty() && has_to_wait(words)) return Progress::Waits;
    since_.reset();
    bool done = words.texts.empty() || !words.error.empty();
    std::optional<double> seconds;
    if (words.texts.size() == 2 && words.texts[0] == "wait") seconds = one_number(words.texts[1]);
    if (seconds && *seconds >= 0) done = true;  // they are over
    done = finish(words, done ? CommandResult{} : line(words));
    awaited_.reset();
    return done ? Progress::Done : Progress::Failed;
}

// What line() would wait for is not there yet.
bool Script::has_to_wait(const Words& words) {
    const std::string& word = words.texts.front();
    bool loading = player_.load_state() == LoadState::Loading;
    if (word != "wait") return loading && word != "quit";
    std::string what = words.texts.size() == 2 ? words.texts[1] : "";
    if (std::optional<double> seconds = one_number(what)) return since_->ms() < 1000 * *seconds;
    if (what == "picture") return loading || waits_for_picture();
    if (what == "refined") return loading || !player_.idle();
    return what == "loaded" && loading;
}

// Not for one of this moment: while a scene plays, the next one is always still to come.
bool Script::waits_for_picture() {
    if (!awaited_) awaited_ = player_.ordered();
    return !awaited_ || !player_.picture_ready(*awaited_);
}

CommandResult Script::line(const Words& words) {
    const std::string& word = words.texts.front();
    std::vector<std::string> rest(words.texts.begin() + 1, words.texts.end());
    if (word == "wait") return wait(words);
    if (word == "expect") return expect(words);
    if (word == "stats") {
        if (rest.size() != 1) return bad("stats takes a file", 0);
        return stats(rest.front());
    }
    if (word == "key") {
        const Command* command = rest.size() == 1 ? find_command_of_key(rest.front()) : nullptr;
        if (!command) return bad("key takes a key that does something, as Ctrl+Z", 1);
        return player_.run(command->word, {});
    }
    if (player_.load_state() == LoadState::Loading && word != "quit")
        player_.wait_loaded(kPatience);
    CommandResult result = player_.run(word, rest);
    if (result.done || result.message.find("there is no command") == std::string::npos)
        return result;
    std::vector<std::string_view> known{"wait", "expect", "stats", "key"};
    for (const Command& command : commands()) known.emplace_back(command.word);
    std::string_view near = nearest_name(word, known);
    return bad(fmt::format("there is no command '{}'{}", word,
                           near.empty() ? "" : fmt::format("; did you mean '{}'?", near)),
               0);
}

CommandResult Script::wait(const Words& words) {
    std::string what = words.texts.size() == 2 ? words.texts[1] : "";
    if (std::optional<double> seconds = one_number(what)) {
        if (*seconds < 0) return bad("time does not go back", 1);
        let_go_by(*seconds);
        return {};
    }
    if (what == "loaded") player_.wait_loaded(kPatience);
    if (what == "picture" && !awaited_) player_.wait_picture(kPatience);
    if (what == "refined") player_.wait_idle(kPatience);
    if (what != "loaded" && what != "picture" && what != "refined")
        return unknown("wait", words, 1, {"SECONDS", "loaded", "picture", "refined"});
    if (player_.load_state() == LoadState::Failed) return bad("there is no scene to wait for", 0);
    return {};
}

// By the clock where it runs; else in steps that are always the same.
void Script::let_go_by(double seconds) {
    player_.wait_loaded(kPatience);
    Stopwatch watch;
    for (double gone = 0; gone < seconds;) {
        double step = std::min(kTick, seconds - gone);
        if (player_.real_time()) {
            std::this_thread::sleep_for(std::chrono::duration<double>(step));
            step = watch.ms() / 1000 - gone;
        }
        player_.advance(step);
        gone += step;
    }
}

CommandResult Script::expect(const Words& words) {
    const std::vector<std::string>& texts = words.texts;
    if (texts.size() > 1 && texts[1] == "pixel") return expect_pixel(words);
    if (texts.size() > 1 && texts[1] == "variable") return expect_variable(words);
    if (texts.size() == 3 && texts[1] == "time") {
        std::optional<double> wanted = one_number(texts[2]);
        if (!wanted) return bad("expect time takes a frame", 2);
        double frame = player_.state().time.frame;
        if (std::abs(frame - *wanted) > 1e-6)
            return bad(fmt::format("the frame is {:g}, not {:g}", frame, *wanted), 2);
        return {};
    }
    if (texts.size() == 3) {
        for (const auto& [name, observable] : observables()) {
            if (texts[1] != name) continue;
            std::string state = player_.observe(observable);
            if (state.find(texts[2]) != std::string::npos) return {};
            return bad(fmt::format("the {} is: {}", name, state), 2);
        }
    }
    return unknown("expect", words, 1,
                   {"pixel", "variable", "time", "camera", "playback", "picture", "selection",
                    "shader", "scene", "panels", "files", "quit"});
}

CommandResult Script::expect_pixel(const Words& words) {
    std::vector<double> numbers;
    for (size_t k = 2; k < words.texts.size(); ++k) {
        std::optional<double> number = one_number(words.texts[k]);
        if (!number) return bad(fmt::format("'{}' is no number", words.texts[k]), k);
        numbers.push_back(*number);
    }
    if (numbers.size() < 5 || numbers.size() > 6)
        return bad("expect pixel takes X Y R G B [TOLERANCE], colors 0 to 255", 1);
    player_.wait_idle(kPatience);
    std::shared_ptr<const Picture> picture = player_.picture();
    if (!picture) return bad("there is no picture", 0);
    if (!(numbers[0] >= 0 && numbers[0] < picture->width && numbers[1] >= 0 &&
          numbers[1] < picture->height))
        return bad(fmt::format("the picture has {} x {} pixels", picture->width, picture->height),
                   2);
    const uint8_t* pixel =
        &picture->rgba[4 * (size_t(numbers[1]) * size_t(picture->width) + size_t(numbers[0]))];
    double tolerance = numbers.size() == 6 ? numbers[5] : 0;
    for (size_t k = 0; k < 3; ++k)
        if (std::abs(pixel[k] - numbers[2 + k]) > tolerance)
            return bad(fmt::format("the pixel is {} {} {}", pixel[0], pixel[1], pixel[2]), 4 + k);
    return {};
}

// Of the clicked pixel, after the line ran last: numbers to 1e-4 of their size, or a text.
CommandResult Script::expect_variable(const Words& words) const {
    const std::vector<std::string>& texts = words.texts;
    std::optional<double> line = texts.size() > 4 ? one_number(texts[3]) : std::nullopt;
    if (!line) return bad("expect variable takes NAME LINE VALUE...", 1);
    const PixelStory* story = player_.state().selection.story.get();
    if (!story) return bad("no surface was clicked", 0);
    const StoryVariable* found = find_variable(*story, texts[2], int(*line));
    if (!found) return bad(fmt::format("line {} does not change '{}'", *line, texts[2]), 2);
    if (found->text) {
        if (texts.size() == 5 && found->texts.size() == 1 && found->texts[0] == texts[4]) return {};
        return bad(fmt::format("{} is \"{}\"", texts[2], fmt::join(found->texts, "\" \"")), 4);
    }
    bool same = texts.size() - 4 == found->values.size();
    for (size_t k = 0; same && k < found->values.size(); ++k) {
        std::optional<double> wanted = one_number(texts[4 + k]);
        if (!wanted) return bad(fmt::format("'{}' is no number", texts[4 + k]), 4 + k);
        double value = double(found->values[k]);
        same = std::abs(value - *wanted) <= 1e-4 * std::max(std::abs(*wanted), 1e-2);
    }
    if (same) return {};
    return bad(fmt::format("{} is {}", texts[2], fmt::join(found->values, " ")), 4);
}

CommandResult Script::stats(const std::string& file) const {
    std::ofstream out(file);
    MakerCounts made = player_.made();
    out << fmt::format("{{\"frames\": {}, \"scenes\": {}, \"kernels\": {}, \"ms\": [",
                       player_.frames_rendered(), made.scenes, made.kernels);
    bool first = true;
    for (const StageTimes& t : player_.stage_times()) {
        out << fmt::format(
            "{}\n  {{\"at\": {:.3f}, \"animate\": {:.3f}, \"skin\": {:.3f}, \"refit\": {:.3f}, "
            "\"trace\": {:.3f}, \"shade\": {:.3f}, \"present\": {:.3f}, \"total\": {:.3f}, "
            "\"scale\": {:.3f}, \"samples\": {}, \"cancelled\": {}}}",
            first ? "" : ",", t.at, t.animate, t.skin, t.refit, t.trace, t.shade, t.present,
            t.total, t.scale, t.samples, t.cancelled);
        first = false;
    }
    out << "\n]}\n";
    if (!out.flush()) return bad(fmt::format("'{}' cannot be written", file), 1);
    return {};
}

}  // namespace kinora
