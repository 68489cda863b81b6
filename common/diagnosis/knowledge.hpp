// What the poses at hand already tell of a model's numbers, and what further poses would see of them.
#pragma once

#include <vector>

#include "diagnosis/diagnosed_model.hpp"
#include "random/random_stream.hpp"

namespace demecal {

/// The model about its present values, less the effects that are asked about: those stand apart, as columns. Laws hold
/// everywhere, also beyond the ranges they were identified in.
class Knowledge {
 public:
  /// `asked`: effects that are not to count as part of the model, whether it holds them or not. `of` must outlive this.
  Knowledge(const DiagnosisData& of, DiagnosedModel model, const std::vector<Effect>& asked, RandomStream random);

  /// The poses at hand, or a sample of them, and how many poses each of the sample stands for.
  const ResidualField& present() const { return at_.fitted; }
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
  const DiagnosisData& of_;
  DiagnosedModel model_;
  Linearised at_;
  double weight_;
  std::vector<Eigen::Index> kept_;  ///< columns of the linearised model that are not asked about
  Eigen::MatrixXd to_units_;        ///< kept x r
};

}  // namespace demecal
