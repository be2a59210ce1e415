// runtime/player/script.h: a player driven by lines of text.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/base/stats.h"
#include "runtime/player/player.h"

namespace kinora {

// Besides the commands: wait SECONDS|loaded|picture|refined, key NAME, expect pixel X Y R G B
// [TOLERANCE], expect variable NAME LINE VALUE..., expect time FRAME, expect state NAME TEXT, stats
// FILE, comments behind #.
class Script {
  public:
    // `name` is the file's, for messages, which go to `report`.
    Script(Player& player, std::string name, std::function<void(const std::string&)> report);

    // Runs all lines; stops at the first that cannot be done. False then.
    bool run(std::string_view text);

    enum class Progress : uint8_t { Done, Waits, Failed };
    // The next line, for a window, whose turns do not wait. Waits: to be called again with the same
    // line in the next turn.
    Progress step(std::string_view line);

  private:
    bool finish(const Words& words, const CommandResult& result);
    bool has_to_wait(const Words& words);
    bool waits_for_picture();
    CommandResult line(const Words& words);
    CommandResult wait(const Words& words);
    CommandResult expect(const Words& words);
    CommandResult expect_pixel(const Words& words);
    CommandResult expect_variable(const Words& words) const;
    CommandResult stats(const std::string& file) const;
    void let_go_by(double seconds);

    Player& player_;
    std::string name_;
    std::function<void(const std::string&)> report_;
    int number_ = 0;                  // of the line
    std::optional<Stopwatch> since_;  // the line that waits
    std::optional<Awaited> awaited_;  // the picture that it waits for (Player::ordered)
};

}  // namespace kinora
