#pragma once

#include <vector>

namespace patchlight {

/// The cells of a hemicube's faces, row by row from the top, and the share of the hemisphere's
/// cosine-weighted light that passes through each (delta form factors of Cohen & Greenberg, "The
/// hemi-cube", 1985, taken at cell centres and divided by their sum, so that the five faces sum to
/// 1). The top face is `width` cells square; the four sides are `width` by `side_height`.
class HemicubeCells {
  public:
    /// 2 cells along the top face's edge, or more.
    explicit HemicubeCells(int resolution);

    int width() const { return width_; }
    int side_height() const { return side_height_; }
    int count() const { return width_ * (width_ + 4 * side_height_); }
    const std::vector<double>& top() const { return top_; }    // [1]
    const std::vector<double>& side() const { return side_; }  // of each of four [1]
    /// What all delta form factors sum to before they are divided by it [1].
    double raw_sum() const { return raw_sum_; }

  private:
    int width_, side_height_;
    std::vector<double> top_, side_;
    double raw_sum_ = 0.0;
};

}  // namespace patchlight
