#include "server/http/render_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace patchlight::server::render_queue_test {
namespace {

bool never() { return false; }
bool always() { return true; }

TEST(RenderQueue, HasRoomForThoseThatRunAndThoseThatWait) {
    RenderQueue queue(1, 2);
    std::vector<std::unique_ptr<RenderQueue::Place>> places;
    for (int k = 0; k < 3; ++k) {
        EXPECT_FALSE(queue.is_full());
        places.push_back(std::make_unique<RenderQueue::Place>(queue));
        EXPECT_TRUE(places.back()->is_taken());
    }
    EXPECT_TRUE(queue.is_full());
    EXPECT_FALSE(RenderQueue::Place(queue).is_taken());
    EXPECT_GT(queue.seconds_until_room(), 0.0);
    places.pop_back();
    EXPECT_TRUE(RenderQueue::Place(queue).is_taken());
}

TEST(RenderQueue, TurnsComeInOrder) {
    RenderQueue queue(1, 2);
    auto first = std::make_unique<RenderQueue::Place>(queue);
    auto second = std::make_unique<RenderQueue::Place>(queue);
    EXPECT_FALSE(second->wait(always)) << "it is not its turn, though nothing runs";
    EXPECT_TRUE(first->wait(never));
    EXPECT_EQ(queue.running(), 1);
    EXPECT_EQ(queue.waiting(), 1);
    first.reset();
    EXPECT_TRUE(second->wait(never));
}

TEST(RenderQueue, WhoGivesUpIsNotWaitedFor) {
    RenderQueue queue(1, 2);
    RenderQueue::Place running(queue);
    ASSERT_TRUE(running.wait(never));
    auto leaving = std::make_unique<RenderQueue::Place>(queue);
    RenderQueue::Place last(queue);
    EXPECT_FALSE(leaving->wait(always));
    leaving.reset();
    EXPECT_EQ(queue.waiting(), 1);
    EXPECT_FALSE(queue.is_full());
}

TEST(RenderQueue, NeverRunsMoreAtOnceThanItMay) {
    RenderQueue queue(2, 20);
    std::atomic<int> running = 0;
    std::atomic<int> most = 0;
    std::atomic<int> done = 0;
    std::vector<std::thread> threads;
    for (int k = 0; k < 16; ++k)
        threads.emplace_back([&] {
            RenderQueue::Place place(queue);
            if (!place.is_taken() || !place.wait(never)) return;
            const int now = ++running;
            for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) continue;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            --running;
            ++done;
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(done, 16);
    EXPECT_LE(most, 2);
    EXPECT_EQ(queue.running() + queue.waiting(), 0);
}

}  // namespace
}  // namespace patchlight::server::render_queue_test
