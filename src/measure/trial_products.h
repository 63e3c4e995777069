// Inner products of the errors of trials among themselves: how much numbers that are made of products of different
// trials, such as structured power, scatter. W. Hoeffding, "A class of statistics with asymptotically normal
// distribution", Annals of Mathematical Statistics 19(3), 1948.
//
// Structured power, the sum over bins of |mean spectrum|^2 - noise / T, is the mean over pairs of different trials of
// their inner product <e_s, e_t>: a U-statistic. Its variance is in those products, whatever the trials have in common
// among their bins; no count of independent bins is needed. Of independent trials e = m + y (m the same in all), with C
// the covariance of y,
//
//   variance = 4 (m, C m) / T + 2 tr C^2 / (T (T - 1)),
//
// and tr C^2 = E <y_s, y_t>^2 is all there is without structure. (The jackknife gives twice that second part: B. Efron
// and C. Stein, "The jackknife estimate of variance", Annals of Statistics 9(3), 1981. It is not used.)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace moire {

struct TrialProducts {
  int groups = 0;                 // 0: nothing is known
  std::int64_t group_trials = 1;  // each group is the mean of that many trials
  std::vector<double> products;   // groups x groups, symmetric: of the groups' mean errors
  std::vector<double> power;      // of each group: mean product of its trials with themselves

  // tr C^2, without bias for trials of any law, and so not always positive: sums over products of two, three and four
  // different groups (J. Li and S. X. Chen, "Two sample tests for high-dimensional covariance matrices", Annals of
  // Statistics 40(2), 2012). Over the square of `unit` > 0, a power of the size of theirs: squares of powers of small
  // errors would underflow. NaN for fewer than 4 groups.
  double squared_covariance(double unit) const;

  // The first part of the variance above, for structured power less `share` times total power instead of structured
  // power alone, so that over the total power it is that of their quotient `share`: 4/T times the variance of a trial's
  // expected part in it. Without bias, and cut off at 0. `trials`: T; `unit` as above. 0 for fewer than 4 groups.
  double linear_variance(double share, std::int64_t trials, double unit) const;
};

// Collects trials into groups, so that memory stays bounded: trials by themselves up to kMostGroups of them; then
// neighbours are joined, and groups hold 2, 4, 8 ... trials. Keeps single precision, in units of the first trials'
// size: products are within 10^-7 of the whole power.
class TrialGroups {
 public:
  static constexpr int kMostGroups = 32;
  static constexpr std::int64_t bytes_per_pixel(std::int64_t trials) {
    return 4 * (trials < kMostGroups ? trials : kMostGroups);
  }

  // One trial: an image, and coordinates along orthonormal images of the part that is to be left out of products. As
  // many numbers in every trial.
  void add(std::span<const double> image, std::span<const double> left_out);

  // `scale` times sums over pixels, less what is left out. A last group that is not full is left out.
  TrialProducts finish(double scale) const;

 private:
  struct Group {
    std::vector<float> image;  // sum over its trials, over unit_
    std::vector<double> left_out;
    double power = 0;  // sum over its trials
    std::int64_t trials = 0;
  };
  void join();

  std::vector<Group> groups_;
  std::int64_t group_trials_ = 1;
  double unit_ = 0;  // a power of two; 0: all trials so far are 0
};

}  // namespace moire
