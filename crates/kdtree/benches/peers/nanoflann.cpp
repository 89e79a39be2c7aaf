// nanoflann on the photons of a file: seconds of CPU time for each job, best of several rounds.
#include <ctime>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>
#include <nanoflann.hpp>

struct Cloud {
    const float* points;
    size_t count;
    size_t kdtree_get_point_count() const { return count; }
    float kdtree_get_pt(size_t i, size_t axis) const { return points[3 * i + axis]; }
    template <class Box> bool kdtree_get_bbox(Box&) const { return false; }
};

static double now() {
    timespec at;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &at);
    return double(at.tv_sec) + 1e-9 * double(at.tv_nsec);
}

// Counts the photons in the ball, and adds their payload where there is one.
struct Sum {
    const float* payload;
    float radius_squared;
    float sum[3] = {0, 0, 0};
    size_t count = 0;
    using DistanceType = float;
    bool addPoint(float distance, unsigned index) {
        if (distance <= radius_squared) {
            count++;
            if (payload)
                for (int c = 0; c < 3; c++) sum[c] += payload[3 * size_t(index) + c];
        }
        return true;
    }
    float worstDist() const { return radius_squared; }
    bool full() const { return true; }
    size_t size() const { return count; }
    void sort() {}
};

int main(int, char** arg) {
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud, 3, unsigned>;
    size_t n = std::stoul(arg[2]), asked[2] = {std::stoul(arg[3]), std::stoul(arg[4])}, k = std::stoul(arg[5]);
    int rounds = std::stoi(arg[6]);
    float radius = std::stof(arg[7]);
    std::vector<float> values(3 * (2 * n + asked[0] + asked[1]));
    std::ifstream(arg[1], std::ios::binary).read(reinterpret_cast<char*>(values.data()), long(values.size() * sizeof(float)));
    const float *payload = &values[3 * n], *queries[2] = {&values[6 * n], &values[6 * n + 3 * asked[0]]};
    Cloud cloud{values.data(), n};
    Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    tree.buildIndex();
    std::vector<unsigned> index(k);
    std::vector<float> distance(k);
    double checksum = 0;
    const char* orders[2] = {"Random", "Coherent"};
    const char* jobs[3] = {"nearest", "radius", "search"};
    for (int job = 0; job < 3; job++)
        for (int order = 0; order < 2; order++) {
            double best = 1e30;
            for (int round = 0; round < rounds; round++) {
                double start = now();
                for (size_t q = 0; q < asked[order]; q++) {
                    const float* at = queries[order] + 3 * q;
                    if (job == 0) {
                        size_t found = tree.knnSearch(at, k, index.data(), distance.data());
                        float sum[3] = {0, 0, 0};
                        for (size_t i = 0; i < found; i++)
                            for (int c = 0; c < 3; c++) sum[c] += payload[3 * size_t(index[i]) + c];
                        checksum += distance[found - 1] + sum[0] + sum[1] + sum[2];
                    } else {
                        Sum set{job == 1 ? payload : nullptr, radius * radius};
                        tree.findNeighbors(set, at, {});
                        checksum += double(set.count) + set.sum[0] + set.sum[1] + set.sum[2];
                    }
                }
                best = std::min(best, now() - start);
            }
            std::printf("%s-%zu-%s %g\n", jobs[job], k, orders[order], best);
        }
    return checksum < 0;
}
