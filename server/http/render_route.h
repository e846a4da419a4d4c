#pragma once

#include "server/http/http_message.h"
#include "server/http/problem.h"
#include "server/http/render_queue.h"
#include "server/http/render_wish.h"
#include "server/http/service_settings.h"

#include <atomic>
#include <mutex>
#include <optional>
#include <vector>

namespace patchlight::server {

/// POST /v1/render: a scene in, its picture or its result out.
class RenderRoute {
  public:
    RenderRoute(const RenderLimits& limits, int threads);

    /// What can be refused before the body is read.
    std::optional<HttpAnswer> admit(const HttpRequest& request) const;

    /// Waits for its turn and solves. Frees the body once it is read.
    HttpAnswer answer(HttpRequest& request);

    /// What runs is stopped and answered with what there is; what waits is refused.
    void cancel() { is_cancelled_ = true; }

    const RenderQueue& queue() const { return queue_; }

  private:
    HttpAnswer solve(const RenderWish& wish, HttpRequest& request, RenderQueue::Place& place);
    Job read_job(std::string& body);
    void cap(Job& job) const;
    std::optional<Problem> over_limit(const Job& job,
                                      const std::vector<PictureRequest>& pictures) const;

    RenderLimits limits_;
    int threads_;
    RenderQueue queue_;
    std::mutex reading_large_body_;
    std::atomic<bool> is_cancelled_ = false;
};

}  // namespace patchlight::server
