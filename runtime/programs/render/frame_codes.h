// runtime/programs/render/frame_codes.h: the exit code of a run from those of its frames.
#pragma once

#include "runtime/programs/common/exit_codes.h"

namespace kinora {

class FrameCodes {
  public:
    explicit FrameCodes(bool keep_going) : keep_going_(keep_going) {}
    // False from the code on at which the run ends.
    bool go_on_after(int code) {
        if (code == kExitOk) return !ended_;
        if (!keep_going_) {
            if (!ended_) code_ = code;
            ended_ = true;
            return false;
        }
        // What a retry may help comes before what it cannot.
        if (code_ != kExitRetry) code_ = code == kExitRetry ? code : int(kExitSomeFailed);
        return true;
    }
    bool ended() const { return ended_; }
    int code() const { return code_; }

  private:
    bool keep_going_, ended_ = false;
    int code_ = kExitOk;
};

}  // namespace kinora
