// What the poses at hand already tell of a model's numbers, and how much further poses would add.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "products/tall_products.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline next_measurement {

/// Sums of products of the model's columns (r) and of those asked about (k), over rows of unit variance.
struct AskedProducts {
  Eigen::MatrixXd cross;  ///< r x k
  Eigen::MatrixXd asked;  ///< k x k
};
AskedProducts asked_products(const RowMatrix& model, const RowMatrix& asked, double weight);

class Separation {
 public:
  /// `present`: of the poses at hand, in coordinates of the model that they know to one unit; `per_pose`: the mean of a
  /// further pose, and `model_per_pose` (r x r) that of the model's products with each other; `precision`: of what is
  /// believed of the asked columns' coefficients, one over their variance (k).
  Separation(const AskedProducts& present, const AskedProducts& per_pose, const Eigen::MatrixXd& model_per_pose,
             const Eigen::VectorXd& precision);

  /// How many columns are asked about.
  Eigen::Index columns() const { return asked_.cols(); }

  /// The sum of squares that the model and the columns `others` leave of column `signal`, at best, after `poses`
  /// further ones: its noncentrality. It never falls as poses are added.
  double information(double poses, const std::vector<Eigen::Index>& others, Eigen::Index signal) const;

  /// How many further poses tell the signal from the others by themselves, one-sided at 5 % with power 0.9, given all
  /// that the poses at hand know of model and others; nothing where `most` would not do.
  std::optional<int> poses_needed(const std::vector<Eigen::Index>& others, Eigen::Index signal, int most) const;

 private:
  Eigen::VectorXd spread_;              ///< of the model's products per pose: its eigenvalues
  Eigen::MatrixXd present_, per_pose_;  ///< cross products along them
  Eigen::MatrixXd asked_, asked_per_pose_;
};

/// The model about its present values, less the effects that are asked about: those stand apart, as columns. Laws hold
/// everywhere, also beyond the ranges they were identified in.
class PosteriorModel {
 public:
  /// `asked`: effects that are not to count as part of the model, whether it holds them or not. `problem` must outlive
  /// this.
  PosteriorModel(const DiagnosisProblem& problem, DiagnosedModel model, const std::vector<Effect>& asked,
                 RandomStream random);

  /// The poses at hand, or a sample of them, and how many poses each of the sample stands for.
  const ResidualField& present() const { return linearization_.fitted; }
  double weight() const { return weight_; }

  /// A data set of `stops` alone, measured where the model predicts them; what each measures is what it measured.
  DataSet predicted(std::vector<MeasuredPose> stops) const;
  /// The field over all poses of such a data set.
  ResidualField field(const DataSet& predicted) const;

  /// rows x r: the model's columns in coordinates that the poses at hand, and what is believed beforehand, know to one
  /// unit each and independently.
  RowMatrix model_columns(const ResidualField& field) const;
  /// rows x coefficients of all `effects`, in order.
  RowMatrix effect_columns(const std::vector<Effect>& effects, const ResidualField& field) const;

  const DiagnosedModel& model() const { return model_; }

 private:
  const DiagnosisProblem& problem_;
  DiagnosedModel model_;
  Linearization linearization_;
  double weight_;
  std::vector<Eigen::Index> kept_;  ///< columns of the linearized model that are not asked about
  Eigen::MatrixXd to_units_;        ///< kept x r
};

}  // namespace demecal::inline next_measurement
