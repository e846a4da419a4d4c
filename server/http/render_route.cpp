#include "server/http/render_route.h"

#include "server/http/scene_problem.h"
#include "server/scene_json.h"
#include "solver/solve_scene.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

namespace patchlight::server {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

Problem busy() {
    return {429,
            "queue-full",
            "Too many renders wait already",
            "wait as long as Retry-After says, and send it again",
            {}};
}

Problem out_of_memory() {
    return {503,
            "out-of-memory",
            "Memory has run out",
            "this server has too little memory at the moment for this request; try again later, or "
            "give a larger patch_size",
            {}};
}

Problem shutting_down() {
    return {
        503, "shutting-down", "The server is shutting down", "send it to another, or later", {}};
}

/// Nobody will read it, but the log will.
HttpAnswer client_gone() {
    HttpAnswer answer;
    answer.status = 499;
    answer.closes = true;
    return answer;
}

Problem too_much(const std::string& kind, const std::string& pointer, const std::string& detail,
                 std::uint64_t asked, std::uint64_t limit) {
    return {422,
            kind,
            "More is asked for than this server gives",
            detail + ": " + std::to_string(asked) + " where the limit is " + std::to_string(limit),
            {{"pointer", pointer}, {"asked", asked}, {"limit", limit}}};
}

/// Asks now and then, as looking at the socket is a system call.
class GoneCheck {
  public:
    explicit GoneCheck(const HttpRequest& request) : request_(request) {}

    bool operator()() {
        constexpr std::chrono::milliseconds interval{20};
        const auto now = Clock::now();
        if (is_gone_ || now < next_) return is_gone_;
        next_ = now + interval;
        is_gone_ = request_.peer_gone && request_.peer_gone();
        return is_gone_;
    }

  private:
    const HttpRequest& request_;
    Clock::time_point next_;
    bool is_gone_ = false;
};

}  // namespace

RenderRoute::RenderRoute(const RenderLimits& limits, int threads)
    : limits_(limits), threads_(threads), queue_(limits.at_once, limits.waiting) {}

std::optional<HttpAnswer> RenderRoute::admit(const HttpRequest& request) const {
    auto wish = read_wish(request);
    if (auto* const refusal = std::get_if<HttpAnswer>(&wish)) return std::move(*refusal);
    return std::nullopt;
}

HttpAnswer RenderRoute::answer(HttpRequest& request) {
    auto wish = read_wish(request);
    if (auto* const refusal = std::get_if<HttpAnswer>(&wish)) return std::move(*refusal);
    RenderQueue::Place place(queue_);
    if (!place.is_taken()) return try_again_later(busy(), queue_.seconds_until_room());
    try {
        return solve(std::get<RenderWish>(wish), request, place);
    } catch (const InputError& error) {
        return answer_of(problem_of(error));
    } catch (const std::bad_alloc&) {
        return try_again_later(out_of_memory(), queue_.seconds_until_room());
    }
}

HttpAnswer RenderRoute::solve(const RenderWish& wish, HttpRequest& request,
                              RenderQueue::Place& place) {
    const Clock::time_point start = Clock::now();
    Job job = read_job(request.body);
    cap(job);
    const auto wished = wished_pictures(wish, job);
    if (const auto* const problem = std::get_if<Problem>(&wished)) return answer_of(*problem);
    const auto& pictures = std::get<std::vector<PictureRequest>>(wished);
    if (const auto problem = over_limit(job, pictures)) return answer_of(*problem);
    const double load = seconds_since(start);

    GoneCheck is_gone(request);
    if (!place.wait([&] { return is_cancelled_ || is_gone(); }))
        return is_gone() ? client_gone() : try_again_later(shutting_down(), 1.0);
    JobResult result = run_job(job, pictures, load, [&](const Progress&) {
        return is_cancelled_ || is_gone() ? Verdict::stop : Verdict::go_on;
    });
    return is_gone() ? client_gone() : render_answer(wish, result);
}

/// Reading takes several times the memory of the text, so large ones are read one by one.
Job RenderRoute::read_job(std::string& body) {
    constexpr std::size_t large = 4 << 20;  // [bytes]
    std::unique_lock alone(reading_large_body_, std::defer_lock);
    if (body.size() > large) alone.lock();
    Job job = read_scene_text(body);
    std::string().swap(body);
    return job;
}

void RenderRoute::cap(Job& job) const {
    SolveSettings& settings = job.settings;
    settings.threads = threads_;
    settings.time_limit = std::min(settings.time_limit.value_or(limits_.seconds), limits_.seconds);
    if (limits_.memory > 0)
        settings.memory_limit =
            std::min(settings.memory_limit.value_or(limits_.memory), limits_.memory);
}

std::optional<Problem> RenderRoute::over_limit(const Job& job,
                                               const std::vector<PictureRequest>& pictures) const {
    std::uint64_t pixels = 0;
    for (const PictureRequest& picture : pictures)
        pixels += static_cast<std::uint64_t>(picture.camera.camera.width) *
                  static_cast<std::uint64_t>(picture.camera.camera.height);
    if (pixels > limits_.pixels)
        return too_much("image-too-large", "/cameras", "pixels in all pictures of the answer",
                        pixels, limits_.pixels);
    const std::size_t sensors = job.scene.sensors.size();
    if (sensors > limits_.sensors)
        return too_much("too-many-sensors", "/sensors", "sensors", sensors, limits_.sensors);
    const auto rays = static_cast<std::uint64_t>(job.settings.rays.value_or(0));
    if (rays > limits_.rays)
        return too_much("too-many-rays", "/solve/rays", "rays per patch", rays, limits_.rays);
    const std::size_t patches = estimate_cost(job.scene, job.settings).patches;
    if (patches > limits_.patches)
        return too_much("too-many-patches", "/solve/patch_size",
                        "patches, which a larger patch_size makes fewer", patches, limits_.patches);
    return std::nullopt;
}

}  // namespace patchlight::server
