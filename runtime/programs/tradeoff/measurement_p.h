// runtime/programs/tradeoff/measurement_p.h: a trade-off under way. Renders the references, then
// each variant between two renders of its base, so that what else the machine does changes both.
#pragma once

#include "runtime/base/stats.h"
#include "runtime/programs/tradeoff/renders.h"
#include "runtime/programs/tradeoff/tradeoff.h"

namespace kinora {

inline constexpr size_t kPreviewRow = 1, kFinalRow = 2, kReferenceRow = 3;

// A scene and what its frames were without noise.
struct Posed {
    std::vector<float> hits;
    std::vector<std::vector<dvec3>> vertices;
    raytrace::Film centres;  // empty where colours are not compared
};

struct TradeBase {
    size_t row;
    PosedScene scene{};
    std::vector<raytrace::Film> films{};        // by frame
    std::vector<PictureErrors> errors{};        // by frame
    std::vector<std::vector<double>> cpu_ms{};  // by frame, all renders
};

// What a row is made of while it is measured.
struct TradeWork {
    TradeRow* row = nullptr;
    size_t index = 0;  // of the row
    PosedScene* scene = nullptr;
    std::unique_ptr<PosedScene> own{};  // where no base has the same
    std::vector<double> ratios{}, wall_ms{};
    std::array<double, kStageCount> stage_shares{};
    std::vector<PictureErrors> errors{};
    bool same = true;
    raytrace::Film film{};
};

class Measurement {
  public:
    Measurement(const TradeoffRequest& request, Diagnostics& diagnostics, TradeResults& results)
        : request_(request), renders_(request, diagnostics), results_(results) {}

    bool run();

  private:
    // measurement.cpp: the plan, the references, the bases, the end.
    bool build_bases();
    bool look_ahead();
    void survey();
    void calibrate();
    void fill_plan_input();
    bool make_plan();
    void make_rows();
    void lower(TradeBase& base, int samples);
    bool make_reference();
    bool reference_frame(size_t f, TradeWork& work);
    void keep_frames(size_t count);
    bool measure_bases();
    void finish();
    double base_ms(size_t base);

    // variants.cpp: rows beside their bases.
    void measure_variants();
    std::vector<std::vector<size_t>> chunks_of_rows();
    void measure_some(const std::vector<size_t>& rows, size_t rounds);
    bool prepare(TradeWork& work);
    void measure_frame(std::vector<TradeWork>& works, TradeBase& base, size_t f, size_t round);
    void compare(TradeWork& work, TradeBase& base, size_t f, bool thumbnail);
    void probe(TradeWork& work, size_t f);
    void conclude(TradeWork& work);
    Posed posed(PosedScene& scene, const Quality& quality, size_t f, bool colours);
    double row_ms(size_t row) const;

    TradeBase& base_of(size_t row) { return row == preview_.row ? preview_ : final_; }
    const Quality& quality_of(const TradeBase& base) const {
        return results_.rows[base.row].variant.quality;
    }
    double left_ms() const { return 1e3 * request_.budget_s - watch_.ms(); }
    void tell(const std::string& text) const;

    const TradeoffRequest& request_;
    TradeRenders renders_;
    TradeResults& results_;
    Stopwatch watch_;
    TradeBase preview_{kPreviewRow}, final_{kFinalRow};
    PosedScene reference_scene_;
    std::vector<ReferencePicture> references_;  // by frame: the mean of two
    std::vector<Posed> reference_posed_;        // by frame
    std::vector<Variant> variants_ = trade_variants();
    std::string surveyed_;  // how small the survey's renders were
    PlanInput input_;
    double pace_ = 1;  // what variants take, to what was estimated
};

// What a frame's stages took, as shares of its CPU time.
void add_stage_shares(TradeWork& work, const TimedFrame& timed);
double median_of(std::vector<double> values);

inline PictureView view_of(const raytrace::Film& film) {
    return {film.width, film.height, film.rgba};
}

}  // namespace kinora
