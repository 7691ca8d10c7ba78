"""Image files as they lie on disk: OpenEXR, PNG and Radiance HDR, read with every size checked before it is trusted."""
