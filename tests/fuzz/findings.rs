//! What runs of the fuzzer found, as it was found.
