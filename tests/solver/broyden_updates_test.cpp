#include "solver/broyden_updates.hpp"

#include "printing.hpp"

namespace hbvm::core {
namespace {

/// F(x) = slope x in one unknown, of which the Jacobian is taken for 1.
template <class S>
struct Line {
  explicit Line(const S& the_slope) : slope(the_slope) {}

  /// The correction at x by that Jacobian, updated.
  S correction(const S& x) {
    StageResidual<S> r{Matrix<S>::Constant(1, 1, S(slope * x)), Matrix<S>::Constant(1, 1, S(slope * x))};
    updates.update(r, scale);
    EXPECT_EQ(r.constraint(0, 0), r.momentum(0, 0));
    return r.momentum(0, 0);
  }
  void keep(const S& correction, bool small = false) {
    updates.keep({Matrix<S>::Constant(1, 1, correction), Matrix<S>::Constant(1, 1, correction)}, scale, small);
  }

  S slope;
  Vector<S> scale = Vector<S>::Constant(1, S(3));
  BroydenUpdates<S> updates{{Matrix<S>::Zero(1, 1), Matrix<S>::Zero(1, 1)}, true};
};

template <class T>
class BroydenUpdatesTest : public InDigits<50> {};
TYPED_TEST_SUITE(BroydenUpdatesTest, AllScalars, ScalarNames);

/// One correction shows all that there is of a line.
TYPED_TEST(BroydenUpdatesTest, OfALineLeadToItsRoot) {
  using S = TypeParam;
  Line<S> line(S(1) / 2);
  const S first = line.correction(S(8));
  EXPECT_EQ(first, S(4));
  line.keep(first);
  EXPECT_EQ(line.correction(S(4)), S(4));
}

TYPED_TEST(BroydenUpdatesTest, AreForgottenWithTheJacobianAndWhatIsSmall) {
  using S = TypeParam;
  Line<S> line(S(1) / 2);
  line.keep(line.correction(S(8)));
  line.updates.clear();
  EXPECT_EQ(line.correction(S(4)), S(2));
  line.keep(S(4));
  line.keep(S(2), true);
  EXPECT_EQ(line.correction(S(4)), S(2));
}

/// A correction that would become many times as long stays what it is.
TYPED_TEST(BroydenUpdatesTest, DoNotBlowACorrectionUp) {
  using S = TypeParam;
  Line<S> line(S(1) / 8);
  line.keep(line.correction(S(8)));
  EXPECT_EQ(line.correction(S(7)), S(7) / 8);
}

TYPED_TEST(BroydenUpdatesTest, AreNoneWhereTheyAreNotUsed) {
  using S = TypeParam;
  const StageResidual<S> like{Matrix<S>::Zero(1, 1), Matrix<S>::Zero(1, 1)};
  BroydenUpdates<S> updates(like, false);
  EXPECT_FALSE(updates.used());
  StageResidual<S> r{Matrix<S>::Constant(1, 1, S(2)), Matrix<S>::Constant(1, 1, S(2))};
  const Vector<S> scale = Vector<S>::Constant(1, S(1));
  updates.keep(r, scale, false);
  updates.update(r, scale);
  EXPECT_EQ(r.momentum(0, 0), S(2));
}

}  // namespace
}  // namespace hbvm::core
