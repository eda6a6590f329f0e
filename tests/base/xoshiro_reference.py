# SPDX-License-Identifier: BSD-3-Clause
"""The reference values of random_test.cc, from the published recurrences in Python's whole numbers."""

MASK = (1 << 64) - 1


def splitmix64(state):
    while True:
        state = (state + 0x9E3779B97F4A7C15) & MASK
        z = state
        z = ((z ^ z >> 30) * 0xBF58476D1CE4E5B9) & MASK
        z = ((z ^ z >> 27) * 0x94D049BB133111EB) & MASK
        yield z ^ z >> 31


def rotate_left(x, k):
    return (x << k | x >> (64 - k)) & MASK


def xoshiro256plusplus(seed):
    words = splitmix64(seed)
    s = [next(words) for _ in range(4)]
    while True:
        yield (rotate_left((s[0] + s[3]) & MASK, 23) + s[0]) & MASK
        t = s[1] << 17 & MASK
        s[2] ^= s[0]
        s[3] ^= s[1]
        s[1] ^= s[2]
        s[0] ^= s[3]
        s[2] ^= t
        s[3] = rotate_left(s[3], 45)


if __name__ == "__main__":
    # The published first output of splitmix64 from state 1234567.
    assert next(splitmix64(1234567)) == 6457827717110365317
    for seed in (0, 42, MASK):
        stream = xoshiro256plusplus(seed)
        print("      {%dU, {%s}}," % (seed, ", ".join("%dU" % next(stream) for _ in range(4))))
