// Times the 24-degree-of-freedom model of uwsbel/low-fidelity-dynamic-models, one drive a line read.
// Built and asked by benchmarks/peer.py; the model itself is not part of this repository.
//
// Arguments: vehicle, tire, suspension and driver file. Answer: processor seconds, steps of 1 ms.

#include <cstdio>
#include <ctime>
#include <iostream>
#include <string>

#include "dof24_halfImplicit.h"

int main(int argc, char** argv) {
    if (argc != 5) return 2;
    d24SolverHalfImplicit solver;
    solver.Construct(argv[1], argv[2], argv[3], argv[4]);
    solver.SetTimeStep(1e-3);
    std::string line;
    while (std::getline(std::cin, line)) {
        const double end = std::stod(line);
        d24::VehicleState vehicle;
        d24::TMeasyState tires[4];
        d24::SuspensionState springs[4];
        solver.Initialize(vehicle, tires[0], tires[1], tires[2], tires[3], springs[0], springs[1],
                          springs[2], springs[3]);
        const long steps = static_cast<long>(end / 1e-3);
        timespec from, to;
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &from);
        // driven on the spot: half throttle and a slight turn, no look-up of a driver's table
        for (long k = 0; k < steps; ++k) solver.IntegrateStep(1e-3 * k, 0.5, 0.05, 0.0);
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &to);
        std::printf("%.9f %ld\n", (to.tv_sec - from.tv_sec) + 1e-9 * (to.tv_nsec - from.tv_nsec), steps);
        std::fflush(stdout);
    }
    return 0;
}
