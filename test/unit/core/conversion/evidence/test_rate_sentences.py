"""Rates in the sentences of seven languages, and sentences that state none."""

import pytest

from mrlab_ros.core.conversion.evidence.rate_sentences import Stated, rate_in


@pytest.mark.parametrize(
    ("text", "rate"),
    [
        ("recorded at 250 Hz", 250),
        ("20 samples per second", 20),
        ("1500 samples per minute", 25),
        ("10 ms per sample", 100),
        ("Abtastzeit: 4 ms", 250),
        ("alle 50 Millisekunden ein Messwert", 20),
        ("Taktrate 20 1/s", 20),
        ("une mesure toutes les 50 millisecondes", 20),
        ("fréquence d'échantillonnage : 125 Hz", 125),
        ("una muestra cada 50 milisegundos", 20),
        ("25 campioni al secondo", 25),
        ("período de amostragem 2,5 ms", 400),
        ("每秒20个点", 20),
        ("采样频率 100 Hz", 100),
    ],
)
def test_a_sentence_that_is_understood_states_its_rate(text, rate):
    assert rate_in(text) == Stated(pytest.approx(rate), sure=True)


@pytest.mark.parametrize(
    "text",
    ["30 fps", "20 Bilder pro Sekunde", "camera 30 fps, joints 20 Hz", "1 of 10 points at 500 Hz"],
)
def test_images_and_words_of_other_data_leave_a_doubt(text):
    assert rate_in(text).sure is False


@pytest.mark.parametrize(
    "text",
    [
        "90 deg per second",
        "moves in 2 s",
        "speed 50 %",
        "50 Hz or 100 Hz",
        "¹ Hz",
        "filtered at 10 Hz",
        "Experiment 12",
    ],
)
def test_other_numbers_state_no_rate(text):
    assert rate_in(text) is None
