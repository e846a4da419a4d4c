#include "solver/transport/conjugate_gradients.h"

#include "solver/transport/gather.h"

namespace patchlight {

ConjugateGradients::ConjugateGradients(const RadiosityProblem& problem, Field residual)
    : problem_(problem), residual_(std::move(residual)) {
    for (std::size_t c = 0; c < problem.channels(); ++c)
        for (std::size_t i = 0; i < problem.size(); ++i)
            if (problem.reflectance[c][i] == 0.0) residual_[c][i] = 0.0;
    direction_ = residual_;
    for (std::size_t c = 0; c < problem.channels(); ++c)
        energy_.push_back(product(c, residual_[c], residual_[c]));
}

double ConjugateGradients::product(std::size_t c, const std::vector<double>& a,
                                   const std::vector<double>& b) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (problem_.reflectance[c][i] > 0.0)
            sum += problem_.area[i] / problem_.reflectance[c][i] * a[i] * b[i];
    return sum;
}

bool ConjugateGradients::step(Field& radiosity) {
    const Field gathered = gather_all(problem_.factors, direction_);
    bool moved = false;
    for (std::size_t c = 0; c < problem_.channels(); ++c) {
        const std::vector<double>& rho = problem_.reflectance[c];
        std::vector<double> image(problem_.size());  // d − ρ F d
        for (std::size_t i = 0; i < image.size(); ++i)
            image[i] = direction_[c][i] - rho[i] * gathered[c][i];
        const double curvature = product(c, direction_[c], image);
        if (!(curvature > 0.0) || !(energy_[c] > 0.0)) continue;
        moved = true;
        const double length = energy_[c] / curvature;
        for (std::size_t i = 0; i < image.size(); ++i) {
            radiosity[c][i] += length * direction_[c][i];
            if (rho[i] > 0.0) residual_[c][i] -= length * image[i];
        }
        const double next = product(c, residual_[c], residual_[c]);
        for (std::size_t i = 0; i < image.size(); ++i)
            direction_[c][i] = residual_[c][i] + next / energy_[c] * direction_[c][i];
        energy_[c] = next;
    }
    return moved;
}

}  // namespace patchlight
