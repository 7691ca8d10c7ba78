def find_faults(*a, **k):
    return ()


def correct(image, *a, **k):
    return image
