"""What a diagnosis says, as plain data, and its JSON form."""

from truck_blowout_sim.diagnosis.result.diagnosis import Diagnosis, write_diagnosis
from truck_blowout_sim.diagnosis.result.evidence import (
    BeatScores,
    Calibrated,
    Candidate,
    ChannelTimeMap,
    Evidence,
    ForceHistory,
    Overlay,
    Role,
)
from truck_blowout_sim.diagnosis.result.parts import (
    KINDS,
    VERDICTS,
    AliasSet,
    ChannelSigma,
    Effect,
    Fit,
    Interval,
    Kind,
    Location,
    Parameter,
    Place,
    Verdict,
    Wrench,
)
from truck_blowout_sim.diagnosis.result.summary import Summary, amount_text, label_of, summarize

__all__ = [
    "KINDS",
    "VERDICTS",
    "AliasSet",
    "BeatScores",
    "Calibrated",
    "Candidate",
    "ChannelSigma",
    "ChannelTimeMap",
    "Diagnosis",
    "Effect",
    "Evidence",
    "Fit",
    "ForceHistory",
    "Interval",
    "Kind",
    "Location",
    "Overlay",
    "Parameter",
    "Place",
    "Role",
    "Summary",
    "Verdict",
    "Wrench",
    "amount_text",
    "label_of",
    "summarize",
    "write_diagnosis",
]
