// runtime/programs/play/headless.h: the player without a window.
#pragma once

#include "runtime/play/player.h"
#include "runtime/programs/play/options.h"

namespace kinora {

// Findings that were not printed yet, to stderr, as the options want them.
class FindingLines {
  public:
    explicit FindingLines(const FindingOptions& options) : options_(options) {}
    void print(const Player& player);
    bool any_error() const { return error_; }

  private:
    FindingOptions options_;
    std::vector<std::string> printed_;
    bool error_ = false;
};

// The script, then the screenshots. The program's exit code.
int run_headless(const PlayOptions& options, Player& player);

}  // namespace kinora
