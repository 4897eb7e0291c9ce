"""Whether the law of an unknown force also predicts runs that were never fitted.

Validated with: test/diagnosis/test_law.py (a law that unseen runs contradict is not added).
"""

from __future__ import annotations

from dataclasses import replace

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.model.law import CONSTANT, Law
from truck_blowout_sim.diagnosis.prove.holdout import predict


def checked(study: Study, law: Law) -> Law:
    """The law with what it does to runs that were never fitted.

    A mere interval is not asked: it says nothing of another run.
    """
    if not study.holdout or not law.values or law.terms[0][0] == CONSTANT:
        return law
    truck, models = study.packed.unchecked(law.values), list(study.models)
    trained = study.simulate([(study.runs[i], truck) for i in study.train])
    for i, model in zip(study.train, trained, strict=True):
        models[i] = model
    held = study.simulate([(run, truck) for run in study.holdout])
    tried = replace(study, packed=truck, models=models, holdout_models=held)
    before, after = (predict(one, one.residual(), ()) for one in (study, tried))
    return replace(law, unseen=(sum(p.chi2 for p in before), sum(p.chi2 for p in after)))
