//! Which input an output's variance comes from (Sobol indices).
