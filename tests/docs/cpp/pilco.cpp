#include "rehearse/moments/expected_return.hpp"
#include "rehearse/moments/make_prior_moments.hpp"
#include "rehearse/moments/moment_term.hpp"
#include "rehearse/optim/cautious_bfgs.hpp"

using namespace rehearse;

void search(const gp::Posterior& posterior_of_residuals, const std::vector<moments::MomentTerm>& terms_of_the_prior,
            Index outputs, const Task& task, std::shared_ptr<const policy::Policy> policy, const Evaluator& evaluator,
            const Vector& start) {
  //: docs/pilco.md exact_terms
  //: docs/pilco.md maximise_cautious_bfgs
}

void around_a_prior(std::shared_ptr<const moments::MomentMatching> gps, const prior::Prior& prior, const Vector& phi,
                    Index dx, Index du, const Task& task, std::shared_ptr<const policy::Policy> policy) {
  //: docs/pilco.md make_prior_moments
}
