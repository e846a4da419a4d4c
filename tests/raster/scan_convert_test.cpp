#include "raster/scan_convert.h"

#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace patchlight::raster::scan_convert_test {
namespace {

/// How often each sample of a square picture is covered.
class CoverageCount {
  public:
    CoverageCount(int size, int samples_per_axis)
        : size_(size), pattern_(sample_pattern(samples_per_axis)) {
        counts_.assign(static_cast<std::size_t>(size * size * pattern_.count), 0);
    }

    /// Draws the triangle whichever way it turns.
    void add(const FixedPoint& a, const FixedPoint& b, const FixedPoint& c) {
        const bool clockwise = turn(a, b, c) > 0;
        if (turn(a, b, c) == 0) return;
        scan_convert(clockwise ? ScreenCorners{a, b, c} : ScreenCorners{a, c, b}, pattern_, size_,
                     {0, size_}, *this);
    }
    void filled(int row, Span columns) {
        for (int x = columns.first; x < columns.last; ++x)
            for (int sample = 0; sample < pattern_.count; ++sample) ++count(row, x, sample);
    }
    void partly(int row, int x, const TriangleEdges& edges) {
        for (int sample = 0; sample < pattern_.count; ++sample)
            if (edges.covered(x, sample / lane_group * lane_group)[sample % lane_group])
                ++count(row, x, sample);
    }

    int& count(int row, int x, int sample) {
        return counts_[static_cast<std::size_t>((row * size_ + x) * pattern_.count + sample)];
    }
    const SamplePattern& pattern() const { return pattern_; }
    const std::vector<int>& counts() const { return counts_; }

  private:
    int size_;
    SamplePattern pattern_;
    std::vector<int> counts_;
};

class ScanConversion : public testing::TestWithParam<int> {};  // samples per axis
INSTANTIATE_TEST_SUITE_P(SamplesPerAxis, ScanConversion, testing::Values(1, 2, 3, 4, 8));

constexpr int size = 24;  // [pixels]
constexpr int end = size * subpixels;

/// Vertices of a grid over the picture, those inside moved at random, not so far that triangles
/// fold over.
std::vector<FixedPoint> moved_grid(int cells, std::mt19937& chance) {
    const int cell = end / cells;
    std::uniform_int_distribution<int> shift(-cell / 7, cell / 7);
    std::vector<FixedPoint> points;
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            const bool inside = i > 0 && i < cells && j > 0 && j < cells;
            points.push_back({i == cells ? end : i * cell + (inside ? shift(chance) : 0),
                              j == cells ? end : j * cell + (inside ? shift(chance) : 0)});
        }
    }
    return points;
}

TEST_P(ScanConversion, OfARandomTriangulationCoversEachSampleOnce) {
    std::mt19937 chance(1);
    for (const int cells : {1, 2, 5, 11, 48, 97}) {
        const std::vector<FixedPoint> points = moved_grid(cells, chance);
        CoverageCount coverage(size, GetParam());
        for (int j = 0; j < cells; ++j) {
            for (int i = 0; i < cells; ++i) {
                const auto first = static_cast<std::size_t>(j * (cells + 1) + i);
                const auto below = first + static_cast<std::size_t>(cells) + 1;
                coverage.add(points[first], points[first + 1], points[below + 1]);
                coverage.add(points[first], points[below + 1], points[below]);
            }
        }
        for (const int count : coverage.counts()) ASSERT_EQ(count, 1) << cells << " cells";
    }
}

TEST_P(ScanConversion, OfAFanOfSliversCoversEachSampleOnce) {
    std::mt19937 chance(2);
    std::uniform_int_distribution<int> inside(1, end - 1);
    for (int trial = 0; trial < 30; ++trial) {
        CoverageCount coverage(size, GetParam());
        FixedPoint hub{inside(chance), inside(chance)};
        if (trial % 2 == 0) {  // on a sample, where all the edges of the fan meet
            hub.x = hub.x / subpixels * subpixels + coverage.pattern().x[0];
            hub.y = hub.y / subpixels * subpixels + coverage.pattern().y[0];
        }
        constexpr int step = 37;  // divides no pixel
        for (int along = 0; along < end; along += step) {
            const int next = std::min(along + step, end);
            coverage.add(hub, {along, 0}, {next, 0});
            coverage.add(hub, {end, along}, {end, next});
            coverage.add(hub, {end - along, end}, {end - next, end});
            coverage.add(hub, {0, end - along}, {0, end - next});
        }
        for (const int count : coverage.counts()) ASSERT_EQ(count, 1);
    }
}

TEST_P(ScanConversion, FollowsTheEdgeFunctionsSampleBySample) {
    std::mt19937 chance(3);
    std::uniform_int_distribution<int> anywhere(0, end);
    const auto is_right_of = [](const FixedPoint& from, const FixedPoint& to, const FixedPoint& p) {
        const std::int64_t side = turn(from, to, p);
        const bool top_or_left = to.y < from.y || (to.y == from.y && to.x > from.x);
        return side > 0 || (side == 0 && top_or_left);
    };
    for (int trial = 0; trial < 60; ++trial) {
        const FixedPoint a{anywhere(chance), anywhere(chance)};
        FixedPoint b{anywhere(chance), anywhere(chance)};
        FixedPoint c{anywhere(chance), anywhere(chance)};
        if (turn(a, b, c) < 0) std::swap(b, c);
        CoverageCount coverage(size, GetParam());
        coverage.add(a, b, c);
        for (int i = 0; i < size * size * coverage.pattern().count; ++i) {
            const int sample = i % coverage.pattern().count;
            const int pixel = i / coverage.pattern().count;
            const auto lane = static_cast<std::size_t>(sample);
            const FixedPoint p{pixel % size * subpixels + coverage.pattern().x[lane],
                               pixel / size * subpixels + coverage.pattern().y[lane]};
            const bool inside =
                is_right_of(a, b, p) && is_right_of(b, c, p) && is_right_of(c, a, p);
            ASSERT_EQ(coverage.count(pixel / size, pixel % size, sample), inside ? 1 : 0);
        }
    }
}

TEST(ScanConversionLimits, TheWidestPictureDoesNotOverflow) {
    constexpr int far_end = most_pixels * subpixels;
    const SamplePattern pattern = sample_pattern(8);
    struct Sink {
        std::int64_t pixels = 0;
        void filled(int, Span columns) { pixels += columns.last - columns.first; }
        void partly(int, int, const TriangleEdges&) {}
    } sink;
    scan_convert({FixedPoint{0, 0}, {far_end, 0}, {far_end, far_end}}, pattern, most_pixels,
                 {most_pixels - 3, most_pixels}, sink);
    EXPECT_EQ(sink.pixels, 0 + 1 + 2);  // right of the diagonal in the last rows
}

TEST(SamplePattern, NoTwoSamplesShareARowOrAColumn) {
    for (int n = 1; n <= most_samples_per_axis; ++n) {
        const SamplePattern pattern = sample_pattern(n);
        EXPECT_EQ(pattern.count, n * n);
        for (std::size_t i = 0; i < static_cast<std::size_t>(pattern.count); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                EXPECT_NE(pattern.x[i], pattern.x[j]);
                EXPECT_NE(pattern.y[i], pattern.y[j]);
            }
        }
    }
}

}  // namespace
}  // namespace patchlight::raster::scan_convert_test
