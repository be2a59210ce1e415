// runtime/player/player.cpp: commands in, orders out to the threads, and what they make taken up.
#include "runtime/player/player.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "runtime/base/parallel.h"
#include "runtime/player/clock.h"
#include "runtime/player/core_p.h"

namespace kinora {

namespace {

constexpr Action kActions[] = {
#define COMMAND(word, ...) action_##word,
#include "runtime/player/commands.def"
#undef COMMAND
};

std::optional<double> number_of(const std::string& text) {
    double value = 0;
    const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* last = text.data() + text.size();
    auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
    return value;
}

// Words against the row's `arguments`. An empty message: they fit.
CommandResult check(const Command& command, const std::vector<std::string>& words) {
    Words wanted = split_words(command.arguments);
    size_t needed = 0;
    for (const std::string& one : wanted.texts) needed += one.front() != '[';
    if (words.size() < needed || words.size() > wanted.texts.size())
        return refused(fmt::format("{} takes {}", command.word,
                                   wanted.texts.empty() ? "nothing" : command.arguments),
                       std::min(words.size(), wanted.texts.size() + 1));
    for (size_t k = 0; k < words.size(); ++k)
        if (wanted.texts[k].find(":number") != std::string::npos && !number_of(words[k]))
            return refused(fmt::format("'{}' is no number", words[k]), k + 1);
    return {};
}

}  // namespace

double Arguments::number(size_t k) const {
    return number_of(words_[k]).value_or(0);
}

std::string unknown_name(const std::string& kind, const std::string& word,
                         const std::vector<std::string>& known) {
    std::string_view near = nearest_name(word, {known.begin(), known.end()});
    return fmt::format("there is no {} '{}'{}", kind, word,
                       near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
}

Player::Player(PlayerSetup setup) : core_(std::make_unique<PlayerCore>(std::move(setup))) {}
Player::~Player() = default;

CommandResult PlayerCore::act(size_t row, const std::vector<std::string>& arguments) {
    return kActions[row](*this, Arguments(arguments));
}

void Player::open(const SceneRequest& request, std::optional<Session> session,
                  std::optional<StartTime> start) {
    const bool first = core_->load == LoadState::Nothing;
    if (first) set_thread_count(request.threads > 0 ? request.threads : thread_count());
    core_->request = request;
    if (!request.scene.empty()) core_->open(request, std::move(session), start);
    // The threads are there from here on; the file is being read meanwhile.
    if (first) parallel_for(0, 2, 1, [](size_t, size_t) {});
}

LoadState Player::load_state() const {
    return core_->load;
}

Opening Player::opening() const {
    return core_->maker.under_way();
}

CommandResult Player::run(std::string_view word, const std::vector<std::string>& arguments) {
    const Command* command = find_command(word);
    if (!command) {
        std::vector<std::string> known;
        for (const Command& c : commands()) known.emplace_back(c.word);
        return refused(unknown_name("command", std::string(word), known));
    }
    if (CommandResult fits = check(*command, arguments); !fits.done) return fits;
    const TimeState before = core_->state.time;
    const CameraState& camera = core_->state.camera;
    std::string turned;
    if (core_->record.is_open() && before.playing && camera.turntable && camera.free)
        turned = camera_text(camera.own);
    core_->await_frame();
    CommandResult result = core_->act(size_t(command - commands().data()), arguments);
    core_->send_order();
    if (result.done) core_->record_line(*command, arguments, before, turned);
    return result;
}

bool Player::record_to(const std::string& file) {
    core_->record.open(file);
    core_->record << "# recorded by kinora-play\n";
    return bool(core_->record.flush());
}

CommandResult Player::run_line(std::string_view line) {
    Words words = split_words(line);
    if (!words.error.empty()) return refused(words.error, words.texts.size() - 1);
    if (words.texts.empty()) return {};
    return run(words.texts.front(), {words.texts.begin() + 1, words.texts.end()});
}

void Player::advance(double seconds) {
    core_->take_news();
    if (!core_->info) return;
    TimeState& time = core_->state.time;
    double before = time.frame;
    core_->since_recorded += seconds;
    bool behind = time.every_frame && core_->setup.real_time &&
                  !(core_->loop.caught_up() && core_->shows_frame());
    if (time.playing && !behind) {
        if (time.every_frame)
            advance_one_frame(time);
        else
            advance_time(time, core_->info->frame_rate, seconds);
        CameraState& camera = core_->state.camera;
        const double length =
            place_of(time, range_last(time)) - place_of(time, range_first(time)) + 1;
        const double gone = place_of(time, time.frame) - place_of(time, before);
        if (camera.turntable && camera.free)
            orbit(camera.own, up_of(core_->info->up_axis), 360 * gone / length, 0);
    }
    core_->send_order();
}

const PlayerState& Player::state() const {
    return core_->state;
}
std::shared_ptr<const Picture> Player::picture() const {
    return core_->loop.picture();
}
std::shared_ptr<const SceneInfo> Player::scene() const {
    return core_->info;
}
const ShaderDocument& Player::shader() const {
    return core_->document;
}
const std::vector<FindingText>& Player::findings() const {
    return core_->all_findings;
}
std::vector<StageTimes> Player::stage_times() const {
    return core_->loop.times();
}
std::vector<std::shared_ptr<const Thumbnail>> Player::thumbnails() const {
    return core_->thumbnails.made();
}
bool Player::idle() const {
    return core_->idle();
}
std::optional<Awaited> Player::ordered() const {
    return core_->ordered();
}
bool Player::picture_ready(const Awaited& of) const {
    return core_->picture_ready(of);
}
bool Player::real_time() const {
    return core_->setup.real_time;
}
uint64_t Player::frames_rendered() const {
    return core_->loop.frames();
}
MakerCounts Player::made() const {
    return core_->maker.counts();
}
SceneError Player::error() const {
    return core_->error;
}

bool Player::wait_loaded(double seconds) {
    return core_->wait_for([&] { return core_->load != LoadState::Loading; }, seconds);
}

bool Player::wait_idle(double seconds) {
    core_->send_order();
    const auto idle = [&] {
        if (!core_->idle()) return false;
        core_->note_stop();  // of a picture that came since the last look
        return core_->idle();
    };
    return core_->wait_for(idle, seconds);
}

bool Player::wait_picture(double seconds) {
    core_->send_order();
    std::optional<Awaited> awaited;
    const auto ready = [&] {
        if (!awaited) awaited = core_->ordered();
        return awaited && core_->picture_ready(*awaited);
    };
    return core_->wait_for(ready, seconds);
}

}  // namespace kinora
