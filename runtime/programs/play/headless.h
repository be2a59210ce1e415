// runtime/programs/play/headless.h: the player without a window.
#pragma once

#include <set>
#include <string>

#include "runtime/player/player.h"
#include "runtime/programs/play/options.h"

namespace kinora {

// Findings that were not printed yet, to stderr, as the options want them.
class PlayerFindings {
  public:
    explicit PlayerFindings(const FindingOptions& options)
        : options_(options), lines_(options.verbose) {}
    void print(const Player& player);
    // How many there were beyond these.
    void summarize();
    // There were errors, or what --fail-on names.
    bool fails() const { return fails_; }
    bool lacks_assets() const { return options_.strict && missing_; }
    bool lacks_memory() const { return lacks_memory_; }

  private:
    FindingOptions options_;
    FindingLines lines_;
    std::set<std::string> seen_;
    bool fails_ = false, missing_ = false, lacks_memory_ = false;
};

// The script, then the screenshots. The program's exit code.
int run_headless(const PlayOptions& options, Player& player);

}  // namespace kinora
