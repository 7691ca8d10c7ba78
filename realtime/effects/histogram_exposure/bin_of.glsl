// The bin that a number of stops falls in; the first and the last hold what lies beyond.
int bin_of(float stops, float low, float high, int bins) {
    return clamp(int(floor((stops - low) / (high - low) * float(bins))), 0, bins - 1);
}
