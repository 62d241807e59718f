# SPDX-License-Identifier: GPL-3.0-or-later
"""The mannequins drafted for, in centimetres: girths as `toile body` tells them, levels over the floor, and what a tailor
would take with the tape besides. Only what a draft uses."""

WOMAN = {  # builtin:woman-38-168
    "bust": 88.0, "waist": 72.0, "hip": 97.0, "neck": 33.5,
    "waist_level": 107.1, "hip_level": 86.0, "armpit_level": 126.4, "bust_level": 122.1,
    "bust_point": 9.6,        # from the middle of the front: where the waist dart points
    "neck_side_level": 141.3,  # top of the shoulder, beside the neck
    "shoulder_slope": 20.0,   # degrees
    "shoulder_half": 17.0,    # from the middle to the shoulder's tip
    "front_length": 40.2,     # beside the neck, over the bust, to the waist
    "back_length": 36.8,      # beside the neck, over the shoulder blade, to the waist
}

MAN = {  # builtin:man-50-178
    "chest": 100.0, "waist": 88.0, "hip": 104.0, "neck": 38.8, "knee": 39.2, "upper_arm": 32.5,
    "waist_level": 114.1, "hip_level": 94.0, "crotch_level": 84.5, "knee_level": 51.6, "armpit_level": 134.0,
    "neck_side_level": 150.2, "shoulder_slope": 20.0, "shoulder_half": 20.5,
}

CHILD = {  # builtin:child-128
    "waist": 58.0, "hip": 69.0, "mid_thigh": 34.6, "knee": 28.0, "calf": 26.5, "ankle": 19.0,
    "waist_level": 79.3, "hip_level": 65.0, "crotch_level": 58.5, "knee_level": 35.7, "calf_level": 27.0,
    "mid_thigh_level": 46.8, "ankle_level": 7.0,
}

ARM_ANGLE = 46.0  # degrees below the horizontal, of every mannequin
