"""Where a shading function's arithmetic breaks: designed extremes and a search, on the device, against float64."""
