//! Statistical tests, whole-program tests and the mutant runner.
